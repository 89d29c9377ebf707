#include "pstripack/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "pstripack/options.h"

namespace program {

namespace {

bool is_silent() { return global().quiet || global().is_led; }
bool is_on_terminal() { return isatty(STDERR_FILENO); }

}  // namespace

void say(const std::string& text) {
  if (!is_silent()) std::fprintf(stderr, "pstripack: %s\n", text.c_str());
}

void Progress::begin(const char* step) {
  start_ = told_ = Clock::now();
  steps_.emplace_back(step, 0);
  if (is_on_terminal() && !is_silent()) fmt::print(stderr, "\rpstripack: {}\033[K", step);
}

void Progress::end() {
  steps_.back().second = seconds();
  if (is_on_terminal() && !is_silent()) fmt::print(stderr, "\r\033[K");
}

void Progress::now(const std::string& doing) {
  const auto pause = is_on_terminal() ? std::chrono::milliseconds(500) : std::chrono::milliseconds(10000);
  if (is_silent() || Clock::now() - told_ < pause) return;
  told_ = Clock::now();
  fmt::print(stderr, is_on_terminal() ? "\rpstripack: {}, {:.0f} s\033[K" : "pstripack: {}, {:.0f} s\n",
             doing, seconds());
}

void Progress::finish(const std::string& what) {
  std::string text = what;
  for (const auto& [doing, seconds] : steps_) text += fmt::format("; {} {:.3f} s", doing, seconds);
  if (global().ranks > 1) text += fmt::format("; on {} ranks", global().ranks);
  say(text);
}

}  // namespace program
