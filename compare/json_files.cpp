#include "json_files.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "capi/pstripack.h"

namespace comparison {
namespace {

using nlohmann::json;

json to_json(const Checked& checked) {
  json j{{"nodes", checked.nodes}, {"valid", checked.nodes > 0 && checked.verdict}};
  if (checked.nodes > 0) {
    j["defect"] = name(checked.verdict.defect);
    j["message"] = checked.verdict.message;
    j["triangles"] = checked.triangles.size();
  }
  return j;
}

json to_json(const Result& result, double timeout) {
  json j;
  j["nodes"] = {{"name", result.points_name}, {"n", result.n}};
  j["original"] = to_json(result.original_checked);
  j["original"]["name"] = result.original_name;
  j["original"]["outcome"] = describe(result.original, timeout);
  if (result.original_returned()) {
    j["original"]["ier"] = result.original.ier;
    j["original"]["seconds"] = result.original.seconds;
  }
  j["pstripack"] = to_json(result.ours_checked);
  j["pstripack"]["version"] = pstripack_version();
  j["pstripack"]["broken_promises"] = result.broken_promises;
  for (const OurRun& ours : result.ours) {
    json run{{"abi", ours.abi},
             {"threads", ours.threads},
             {"ranks", ours.ranks},
             {"partition", ours.partition},
             {"same_bytes", same_bytes(ours, result.ours.front())}};
    if (ours.failure.empty()) {
      run["ier"] = ours.ier;
      run["seconds"] = ours.seconds;
    } else {
      run["failure"] = ours.failure;
    }
    if (result.original_returned() && ours.failure.empty())
      run["ratio"] = result.original.seconds / ours.seconds;
    j["pstripack"]["runs"].push_back(run);
  }
  if (result.ier)
    j["ier_difference"] = {{"cause", identifier(result.ier->cause)}, {"text", result.ier->text}};
  if (result.meshes_compared) {
    const Differences& d = result.differences;
    j["triangles_equal"] = d.none();
    j["boundary_equal"] = result.original_boundary == result.our_boundary;
    j["boundary_nodes"] = {{"original", result.original_boundary.size()},
                           {"pstripack", result.our_boundary.size()}};
    for (std::size_t c = 0; c < kCauses; ++c)
      j["differences"][identifier(static_cast<Cause>(c))] = {{"places", d.count[c].places},
                                                             {"original_arcs", d.count[c].original_arcs},
                                                             {"our_arcs", d.count[c].our_arcs}};
    j["examples"] = json::array();
    for (const Decision& decision : d.decisions) {
      json nodes = json::array();
      for (const auto node : decision.nodes) nodes.push_back(node + 1);
      j["examples"].push_back({{"cause", identifier(decision.cause)},
                               {"nodes", nodes},
                               {"text", decision.text},
                               {"determinant", decision.determinant},
                               {"bound", decision.bound}});
    }
  }
  j["verdict"] = verdict_of(result);
  return j;
}

}  // namespace

struct JsonFile::Document {
  std::string name;
  std::ofstream out;
  json results = json::array();

  void write(const json& j) {
    const std::string text =
        j.dump(2, ' ', false, json::error_handler_t::replace);  // names may have any bytes
    if (!(out << text << '\n' << std::flush)) throw std::runtime_error("cannot write " + name);
  }
};

JsonFile::JsonFile(const std::string& file) : document_(new Document{file, std::ofstream(file)}) {
  if (!document_->out) throw std::runtime_error("cannot write " + file);
}
JsonFile::~JsonFile() = default;

void JsonFile::add(const Case& one, double timeout) {
  json j = to_json(one.result, timeout);
  j["nodes"]["seed"] = one.seed;
  j["order"] = one.order;
  j["precision"] = one.precision;
  document_->results.push_back(std::move(j));
}

void JsonFile::add(const Call& call, const Result& result, const std::string& kind, const std::string& text,
                   double timeout) {
  json j = result.n > 0 ? to_json(result, timeout) : json::object();
  j["call"] = call.number;
  j["process"] = call.process_id;
  j["n"] = call.n;
  j["real_bytes"] = call.real_bytes;
  j["kind"] = kind;
  j["text"] = text;
  document_->results.push_back(std::move(j));
}

void JsonFile::write_cases(const Summary& summary, int exit_code) {
  document_->write({{"cases", document_->results},
                    {"summary",
                     {{"cases", summary.cases},
                      {"equal", summary.equal},
                      {"explained", summary.explained},
                      {"no_result", summary.no_result},
                      {"against_us", summary.against_us}}},
                    {"exit_code", exit_code}});
}

void JsonFile::write_calls(const std::string& recording, const std::string& original, int exit_code) {
  document_->write(
      {{"file", recording}, {"original", original}, {"calls", document_->results}, {"exit_code", exit_code}});
}

}  // namespace comparison
