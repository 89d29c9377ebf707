// stripack-compare replay: repeats recorded calls of TRMESH with the original or another library and explains
// every difference. Also the process beside a model with PSTRIPACK_CHECK=lib:LIBRARY.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "calls.h"
#include "capi/pstripack.h"
#include "chosen_original.h"
#include "commands.h"
#include "comparison.h"
#include "json_files.h"
#include "list_files.h"
#include "lists/adjacency_lists.h"
#include "show_result.h"

namespace comparison {
namespace {

/// Kinds of verdicts, from harmless to serious.
enum class Kind { equal, explained, no_original, not_compared, against_us };
constexpr std::size_t kKinds = 5;
constexpr const char* kKindNames[kKinds] = {"equal", "explained", "no result of the original", "not compared",
                                            "WE ARE WRONG"};

/// The report on one call: the text of its line, and further lines.
struct Judgement {
  Kind kind = Kind::equal;
  std::string text;
  std::vector<std::string> reasons;
  Result result;  ///< n = 0: nothing was compared
};

std::string places_of(const Differences& differences) {
  std::string text;
  for (std::size_t c = 0; c < kCauses; ++c)
    if (const std::size_t places = differences.count[c].places; places > 0)
      text += fmt::format("{}{} {} place{}", text.empty() ? "" : ", ", name(static_cast<Cause>(c)), places,
                          places == 1 ? "" : "s");
  return text;
}

class Replay {
 public:
  explicit Replay(const ReplayOptions& options) : options_(options), reader_(options.file) {
    if (!options.json_file.empty()) json_.emplace(options.json_file);
  }

  int run() {
    std::exception_ptr unreadable;
    try {
      while (std::optional<Call> call = reader_.next()) {
        if (!other_) open_other(*call);
        tell(*call, judge(*call));
      }
      if (calls_ == 0 && !is_beside_model())
        throw std::runtime_error(options_.file + ": no call is recorded in it");
    } catch (...) {
      unreadable = std::current_exception();
    }
    if (calls_ > 0) summarise();
    if (unreadable) std::rethrow_exception(unreadable);
    return exit_code();
  }

 private:
  /// Loads the original at the first call. The recording's kinds are used unless the original's ABI is
  /// detected.
  void open_other(const Call& call) {
    if (is_beside_model()) prefix_ = fmt::format("pstripack[{}]: ", call.process_id);
    OriginalChoice choice = options_.original;
    if (!options_.library.empty()) choice.file = options_.library;
    other_.emplace(open_original(choice, options_.timeout, static_cast<int>(call.real_bytes)));
    fmt::print("{}{}: {}\n", prefix_, options_.library.empty() ? "original" : "library", other_->name);
  }

  bool is_beside_model() const { return options_.file == "-"; }

  ExitCode exit_code() const { return count(Kind::against_us) > 0 ? kAgainstUs : kExplained; }
  const char* name_of(Kind kind) const {
    const bool is_of_library = kind == Kind::against_us && !options_.library.empty();
    return is_of_library ? "OTHER RESULTS" : kKindNames[static_cast<std::size_t>(kind)];
  }
  std::size_t count(Kind kind) const { return kinds_[static_cast<std::size_t>(kind)]; }

  Judgement judge(Call& call) {
    if (call.points.empty()) return judge_refused(call);
    std::string before;
    if (!call.has_returned && call.run.order == "delaunay")
      return {Kind::not_compared, "no result on record", {}, {}};
    if (!call.has_returned) {
      if (auto lost = run_again(call)) return *std::move(lost);
      before = "no result on record, run again: ";
    }
    if (call.run.ier == PSTRIPACK_OUT_OF_MEMORY || call.run.ier == PSTRIPACK_RANKS_DISAGREE ||
        call.run.ier == PSTRIPACK_BAD_COMM)
      return {Kind::not_compared,
              fmt::format("{}IER = {}, {}", before, call.run.ier, pstripack_strerror(call.run.ier)),
              {},
              {}};
    if (call.real_bytes == 8 && other_->original.library().abi().real_bytes == 4)
      throw std::runtime_error(
          fmt::format("call {} is one in REAL*8: a library in REAL*4 would get other nodes", call.number));
    Judgement judgement = judge_result(call);
    judgement.text = before + judgement.text;
    return judgement;
  }

  /// Judges a call whose n TRMESH refuses without reading nodes.
  static Judgement judge_refused(const Call& call) {
    const int expected = call.n < 3 ? PSTRIPACK_TOO_FEW_NODES : PSTRIPACK_TOO_MANY_NODES;
    if (!call.has_returned) return {Kind::not_compared, "no result on record", {}, {}};
    if (call.run.ier == expected) return {Kind::equal, fmt::format("IER = {}", expected), {}, {}};
    return {Kind::against_us, fmt::format("IER = {}, expected {}", call.run.ier, expected), {}, {}};
  }

  /// Repeats a call that had not returned when the recording ended, and fills in its result. Returns a
  /// verdict only if the call does not return here either.
  std::optional<Judgement> run_again(Call& call) const {
    call.run = run_ours(call.points, Setting(call.run), 1, options_.timeout);
    if (!call.run.failure.empty())
      return Judgement{
          Kind::against_us, "no result on record, run again: PSTRIPACK " + call.run.failure, {}, {}};
    call.nodes = call.run.ier == 0  ? call.points.size()
                 : call.run.ier > 0 ? nodes_before_duplicate(call.points, call.run.ier)
                                    : 0;
    return std::nullopt;
  }

  Judgement judge_result(const Call& call) const {
    const bool is_delaunay = call.run.order == "delaunay";
    // A library of ours reads it at its first call, in a child.
    if (!options_.library.empty()) setenv("PSTRIPACK_ORDER", is_delaunay ? "" : call.run.order.c_str(), 1);
    legacy_stripack::Triangulation theirs = other_->original.triangulate(call.points, options_.timeout);
    // A library of ours gives the recorded bytes; in the original's order only in the same precision, and in
    // a program's first call, since its searches draw random numbers whose seeds are kept. An original gives
    // its own bytes only if it was compiled as ours follows it (docs/original-order.md).
    const bool is_our_order = call.run.is_canonical();
    const bool is_same_search =
        call.number == 1 && static_cast<int>(call.real_bytes) == other_->original.library().abi().real_bytes;
    const bool must_be_equal = !options_.library.empty() && !is_delaunay && (is_our_order || is_same_search);
    const std::string other_bytes = must_be_equal || !is_our_order ? difference_in_bytes(theirs, call) : "";
    if (!is_our_order && call.nodes > 0 && other_bytes.empty()) return {Kind::equal, "same bytes", {}, {}};
    Judgement judgement;
    judgement.result =
        compare(call.points, std::move(theirs), other_->original.epsilon(), {call.run}, options_.show);
    const Result& result = judgement.result;
    judgement.text = verdict_of(result);
    if (must_be_equal && !other_bytes.empty()) {
      judgement.kind = Kind::against_us;
      judgement.text = other_bytes;
    } else if (result.against_us()) {
      judgement.kind = Kind::against_us;
    } else if (!result.ours_is_exact()) {
      judgement.kind = Kind::explained;
      judgement.text = fmt::format("a mesh of rounded tests, as {} asks for ({}); {}", call.run.order,
                                   result.ours_checked.verdict.message, other_bytes);
    } else if (!result.original_returned()) {
      judgement.kind = Kind::no_original;
      judgement.text = fmt::format("the original {}; ours passes every exact check",
                                   describe(result.original, options_.timeout));
    } else if (result.equal()) {
      judgement.kind = Kind::equal;
      if (must_be_equal) judgement.text = "same bytes";
    } else {
      judgement.kind = Kind::explained;
    }
    if (const std::string places = places_of(result.differences); !places.empty())
      judgement.text += ": " + places;

    for (const std::string& broken : result.broken_promises)
      judgement.reasons.push_back("WE ARE WRONG: " + broken);
    if (result.ier)
      judgement.reasons.push_back(fmt::format("{}: {}", name(result.ier->cause), result.ier->text));
    for (const Decision& d : result.differences.decisions)
      judgement.reasons.push_back(fmt::format("{}: {}", name(d.cause), d.text));
    return judgement;
  }

  /// Compares with the recorded bytes, which every version of PSTRIPACK must return. Empty if equal.
  std::string difference_in_bytes(const legacy_stripack::Triangulation& theirs, const Call& call) const {
    if (theirs.outcome != legacy_stripack::Outcome::returned)
      return (options_.library.empty() ? "the original " : "the library ") +
             describe(theirs, options_.timeout);
    if (theirs.ier != call.run.ier) return fmt::format("IER = {} recorded, now {}", call.run.ier, theirs.ier);
    Lists lists{theirs.list, theirs.lptr, theirs.lend, theirs.lnew};
    if (lists.lnew == 0) lists.lnew = call.run.lists.lnew;  // the 8-argument TRMESH does not return it
    const ByteComparison bytes = compare_bytes(call.run.lists, call.nodes, lists, call.nodes);
    if (bytes.different == 0) return "";
    return fmt::format("OTHER BYTES: {} entries, first recorded and now {}", bytes.different, bytes.first);
  }

  void tell(const Call& call, Judgement judgement) {
    if (calls_++ == 0) first_process_ = call.process;
    std::string which = fmt::format("call {}", call.number);
    if (call.process != first_process_) which += fmt::format(" of process {}", call.process_id);
    fmt::print("{}{}: n = {}: {}\n", prefix_, which, call.n, judgement.text);
    for (const std::string& reason : judgement.reasons) fmt::print("{}  {}\n", prefix_, reason);
    std::fflush(stdout);

    ++kinds_[static_cast<std::size_t>(judgement.kind)];
    Result& result = judgement.result;
    result.points_name = which;
    result.original_name = other_->name;
    for (std::size_t c = 0; c < kCauses; ++c) places_[c] += result.differences.count[c].places;
    if (result.n > 0 && result.original_returned()) {
      their_seconds_ += result.original.seconds;
      our_seconds_ += call.run.seconds;
    }
    if (json_) json_->add(call, result, name_of(judgement.kind), judgement.text, options_.timeout);
  }

  void summarise() {
    fmt::print("{}{} call{}", prefix_, calls_, calls_ == 1 ? "" : "s");
    for (std::size_t k = 0; k < kKinds; ++k)
      if (kinds_[k] > 0) fmt::print(", {} {}", kinds_[k], name_of(static_cast<Kind>(k)));
    fmt::print("\n");
    for (std::size_t c = 0; c < kCauses; ++c)
      if (places_[c] > 0)
        fmt::print("{}  {}: {} place{}\n", prefix_, name(static_cast<Cause>(c)), places_[c],
                   places_[c] == 1 ? "" : "s");
    if (our_seconds_ > 0)
      fmt::print("{}  seconds in TRMESH: {} {:.4g}, recorded {:.4g}\n", prefix_,
                 options_.library.empty() ? "original" : "library", their_seconds_, our_seconds_);
    std::fflush(stdout);
    if (json_) json_->write_calls(options_.file, other_->name, exit_code());
  }

  const ReplayOptions& options_;
  CallReader reader_;
  std::optional<ChosenOriginal> other_;
  std::string prefix_;  ///< of every line that is printed among those of a model
  std::size_t calls_ = 0;
  std::uint64_t first_process_ = 0;
  std::array<std::size_t, kKinds> kinds_{};
  std::array<std::size_t, kCauses> places_{};
  double their_seconds_ = 0, our_seconds_ = 0;
  std::optional<JsonFile> json_;
};

}  // namespace

int replay(const ReplayOptions& options) { return Replay(options).run(); }

}  // namespace comparison
