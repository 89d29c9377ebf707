#include "pstripack/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "pstripack/options.h"

namespace program {

namespace {

bool is_silent() { return global().quiet || global().is_led; }

}  // namespace

void say(const std::string& text) {
  if (!is_silent()) std::fprintf(stderr, "pstripack: %s\n", text.c_str());
}

Progress::Progress() : on_terminal_(isatty(STDERR_FILENO)) {
  if (!is_silent()) reporter_ = std::thread([this] { report(); });
}

Progress::~Progress() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  wake_.notify_one();
  if (reporter_.joinable()) reporter_.join();
}

void Progress::begin(const char* step) {
  const std::lock_guard<std::mutex> lock(mutex_);
  step_ = doing_ = step;
  start_ = Clock::now();
}

void Progress::end() {
  const std::lock_guard<std::mutex> lock(mutex_);
  steps_.emplace_back(step_, seconds());
  doing_.clear();
  if (on_terminal_ && !is_silent()) fmt::print(stderr, "\r\033[K");
}

void Progress::now(std::string doing) {
  const std::lock_guard<std::mutex> lock(mutex_);
  doing_ = std::move(doing);
}

void Progress::report() {
  const auto pause = on_terminal_ ? std::chrono::milliseconds(500) : std::chrono::milliseconds(10000);
  std::unique_lock<std::mutex> lock(mutex_);
  while (!wake_.wait_for(lock, pause, [this] { return ends_; })) {
    if (doing_.empty()) continue;
    fmt::print(stderr, on_terminal_ ? "\rpstripack: {}, {:.0f} s\033[K" : "pstripack: {}, {:.0f} s\n", doing_,
               seconds());
    std::fflush(stderr);
  }
}

void Progress::finish(const std::string& what) {
  std::string text = what;
  for (const auto& [doing, seconds] : steps_) text += fmt::format("; {} {:.3f} s", doing, seconds);
  if (global().ranks > 1) text += fmt::format("; on {} ranks", global().ranks);
  say(text);
}

}  // namespace program
