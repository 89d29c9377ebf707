#include "case_files.h"

#include <fmt/format.h>

#include <cstddef>
#include <stdexcept>

#include "capi/pstripack.h"
#include "pictures/svg.h"

namespace comparison {
namespace {

using pictures::escaped_for_xml;

constexpr auto kLine = "{:<18} {:<8} {:<4} {:>8} {:>6} {:<18} {:>9} {:>9} {:>6}  {:<12} {}\n";

std::string both_codes(const Result& result) {
  const int ours = result.ours.front().ier;
  if (!result.original_returned() || result.original.ier == ours) return std::to_string(ours);
  return fmt::format("{}/{}", result.original.ier, ours);
}

std::string original_in_short(const Result& result) {
  using legacy_stripack::Outcome;
  switch (result.original.outcome) {
    case Outcome::timed_out:
      return "did not return";
    case Outcome::crashed:
      return "crashed";
    case Outcome::stopped:
      return "stopped";
    case Outcome::returned:
      break;
  }
  const Checked& checked = result.original_checked;
  if (checked.nodes == 0) return "no mesh";
  if (checked.verdict) return "valid";
  if (!only_ties_and_rounding(result)) return name(checked.verdict.defect);
  return result.differences.of(Cause::rounding).places > 0 ? "valid but rounding" : "valid but ties";
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

std::ofstream opened(const std::string& name) {
  std::ofstream out(name);
  if (!out) throw std::runtime_error("cannot write " + name);
  return out;
}

}  // namespace

std::string differences_in_short(const Result& result) {
  if (result.ier) return "IER";
  if (!result.meshes_compared) return result.original_returned() ? "none" : "-";
  static const char* const names[kCauses] = {"ties", "rounding", "lengths", "original wrong", "OURS WRONG"};
  std::string text;
  for (std::size_t c = 0; c < kCauses; ++c)
    if (const std::size_t places = result.differences.count[c].places; places > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", places, names[c]);
  return text.empty() ? "none" : text;
}

void print_header_of_cases() {
  fmt::print(kLine, "nodes", "order", "real", "n", "IER", "original", "orig. s", "ours s", "ratio", "verdict",
             "places that differ");
}

void print_line(const Case& one) {
  const Result& result = one.result;
  const OurRun& ours = result.ours.front();
  const bool both = result.original_returned() && ours.failure.empty();
  fmt::print(kLine, one.nodes, one.order, one.precision, result.n, both_codes(result),
             original_in_short(result),
             result.original_returned() ? fmt::format("{:.4g}", result.original.seconds) : "-",
             ours.failure.empty() ? fmt::format("{:.4g}", ours.seconds) : "-",
             both ? fmt::format("{:.1f}", result.original.seconds / ours.seconds) : "-",
             verdict_in_short(result), differences_in_short(result));
}

CsvFile::CsvFile(const std::string& file) : name_(file), out_(opened(file)) {
  out_ << "nodes,seed,order,precision,n,original_outcome,original_ier,original_valid,original_seconds,abi,"
          "threads,ranks,"
          "partition,ier,valid,same_bytes,seconds";
  for (std::size_t c = 0; c < kCauses; ++c) out_ << ',' << identifier(static_cast<Cause>(c));
  out_ << ",verdict\n";
}

void CsvFile::add(const Case& one) {
  const Result& r = one.result;
  const auto valid = [](const Checked& checked) { return checked.nodes > 0 && checked.verdict ? 1 : 0; };
  for (const OurRun& ours : r.ours) {
    out_ << fmt::format("{},{},{},{},{},{}", quoted(one.nodes), one.seed, one.order, one.precision, r.n,
                        original_in_short(r));
    if (r.original_returned())
      out_ << fmt::format(",{},{},{}", r.original.ier, valid(r.original_checked), r.original.seconds);
    else
      out_ << ",,,";
    out_ << fmt::format(",{},{},{},{}", ours.abi, ours.threads, ours.ranks, ours.partition);
    if (ours.failure.empty())
      out_ << fmt::format(",{},{},{},{}", ours.ier, valid(r.ours_checked),
                          same_bytes(ours, r.ours.front()) ? 1 : 0, ours.seconds);
    else
      out_ << ",,,,";
    for (const Count& count : r.differences.count) out_ << ',' << count.places;
    out_ << ',' << verdict_in_short(r) << '\n';
  }
  if (!(out_ << std::flush)) throw std::runtime_error("cannot write " + name_);
}

JunitFile::JunitFile(const std::string& file) : name_(file), out_(opened(file)) {}

void JunitFile::add(const Case& one, double timeout) {
  const Result& r = one.result;
  std::string text =
      fmt::format("original: {}, {}\nIER: {}\ndifferences (places): {}\nverdict: {}\n", r.original_name,
                  describe(r.original, timeout), both_codes(r), differences_in_short(r), verdict_of(r));
  if (r.ier) text += fmt::format("{}: {}\n", name(r.ier->cause), r.ier->text);
  for (const Decision& d : r.differences.decisions) text += fmt::format("{}: {}\n", name(d.cause), d.text);
  for (const std::string& line : r.broken_promises)
    text += fmt::format("{}: {}\n", name(Cause::ours_wrong), line);

  cases_ += fmt::format("  <testcase classname=\"stripack-compare\" name=\"{}\" time=\"{:.3f}\">\n",
                        escaped_for_xml(r.points_name), one.seconds);
  if (r.against_us())
    cases_ += fmt::format("    <failure message=\"{}\"/>\n", escaped_for_xml(verdict_of(r)));
  cases_ += fmt::format("    <system-out>{}</system-out>\n  </testcase>\n", escaped_for_xml(text));
  ++tests_;
  if (r.against_us()) ++failures_;
  seconds_ += one.seconds;
}

void JunitFile::write() {
  out_ << fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"stripack-compare {}\" tests=\"{}\" "
      "failures=\"{}\" "
      "errors=\"0\" skipped=\"0\" time=\"{:.3f}\">\n{}</testsuite>\n",
      pstripack_version(), tests_, failures_, seconds_, cases_);
  if (!(out_ << std::flush)) throw std::runtime_error("cannot write " + name_);
}

}  // namespace comparison
