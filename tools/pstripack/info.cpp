// `pstripack info`.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "files/measures.h"
#include "geometry/measures.h"
#include "pstripack/options.h"
#include "pstripack/progress.h"
#include "standard_streams.h"
#include "stripack/list_queries.h"

namespace program {
namespace {

using files::Mesh;

struct InfoOptions {
  Input input;
  bool json = false;
};

/// A value, and the nodes (from 1, in the input) that have it.
struct Extreme {
  double value;
  std::int32_t first = 0, second = 0;
};

struct Facts {
  std::size_t triangles = 0, arcs = 0, boundary = 0, near = 0;
  Extreme fewest{1e300}, most{0}, shortest{1e300}, longest{0}, sharpest{1e300};
  double mean = 0;  ///< length of an arc
};

/// Nodes closer than this fraction of the mean arc are near duplicates.
constexpr double kNear = 1e-3;

Facts facts_of(const Mesh& mesh) {
  Facts facts;
  const pstripack::Directions nodes(mesh.points.data(), mesh.points.size());
  const auto at = [&](std::int32_t node) { return pstripack::direction_of(nodes, node - 1); };
  const pstripack::ListReader<std::int32_t> reader(mesh.lists());
  std::vector<double> lengths;
  for (std::int32_t node = 1; node <= reader.size(); ++node) {
    double degree = 0;
    reader.for_each_neighbour(node, [&](std::int32_t neighbour) {
      ++degree;
      if (neighbour < node) return;
      const double length = arc_length(at(node), at(neighbour));
      lengths.push_back(length);
      facts.mean += length;
      if (length < facts.shortest.value) facts.shortest = {length, node, neighbour};
      if (length > facts.longest.value) facts.longest = {length, node, neighbour};
    });
    if (reader.on_boundary(node)) ++facts.boundary;
    if (degree < facts.fewest.value) facts.fewest = {degree, node};
    if (degree > facts.most.value) facts.most = {degree, node};
  }
  facts.arcs = lengths.size();
  facts.mean /= static_cast<double>(lengths.size());
  facts.near = static_cast<std::size_t>(std::count_if(
      lengths.begin(), lengths.end(), [&](double length) { return length < kNear * facts.mean; }));
  const std::vector<std::int32_t> triangles = files::triangles_of(mesh);
  facts.triangles = triangles.size() / 3;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const pstripack::Angles angles = angles_of(at(triangles[t]), at(triangles[t + 1]), at(triangles[t + 2]));
    for (std::size_t k = 0; k < 3; ++k)
      if (const double angle = angles.at[k] * files::kRadian; angle < facts.sharpest.value)
        facts.sharpest = {angle, triangles[t + k]};
  }
  return facts;
}

void info(const InfoOptions& options) {
  Progress progress;
  files::Nodes nodes = progress.step("reading", [&] { return read_nodes(options.input); });
  const std::size_t given = nodes.points.size();
  std::vector<files::Duplicate> duplicates;
  const Mesh mesh = progress.step("triangulating", [&] {
    return with_nodes(nodes, [&] {
      duplicates = files::duplicates(nodes.points);
      return files::triangulate(files::values_at(nodes.points, without(duplicates, given)));
    });
  });
  const Facts f = progress.step("measuring", [&] { return facts_of(mesh); });
  const std::vector<std::size_t> kept = without(duplicates, given);
  const auto number = [&](std::int32_t n) { return nodes.number(kept[static_cast<std::size_t>(n) - 1]); };
  const auto place = [&](std::int32_t n) { return nodes.place(kept[static_cast<std::size_t>(n) - 1]); };

  using Json = nlohmann::ordered_json;
  Json json;
  std::string text;
  const auto line = [&](const char* name, const std::string& value) {
    text += fmt::format("{:<16} {}\n", name, value);
  };
  const auto add = [&](const char* key, const Json& value, const char* name, const std::string& of_text) {
    json[key] = value;
    line(name, of_text);
  };
  const auto extreme = [&](const Extreme& e) {
    Json j{{"value", e.value}, {"nodes", {number(e.first)}}};
    if (e.second > 0) j["nodes"].push_back(number(e.second));
    return j;
  };
  const auto length = [](double arc) {
    return fmt::format("{:.6g} rad, {:.6g} degrees", arc, arc * files::kRadian);
  };
  const auto pair = [&](const Extreme& e) {
    return fmt::format("{}: {} and {}", length(e.value), place(e.first), place(e.second));
  };
  line("file", fmt::format("{} ({})", nodes.file, nodes.kind));
  json["file"] = nodes.file;
  json["kind"] = nodes.kind;
  add("nodes", given, "nodes", fmt::format("{}", given));
  add("duplicates", duplicates.size(), "duplicates",
      duplicates.empty() ? "none"
                         : fmt::format("{}, the first is {}; left out below", duplicates.size(),
                                       nodes.place(duplicates[0].node)));
  json["duplicate_pairs"] = Json::array();
  for (const files::Duplicate& d : duplicates)
    json["duplicate_pairs"].push_back({nodes.number(d.first), nodes.number(d.node)});
  add("triangles", f.triangles, "triangles", fmt::format("{}", f.triangles));
  add("arcs", f.arcs, "arcs", fmt::format("{}", f.arcs));
  add("boundary_nodes", f.boundary, "boundary",
      f.boundary == 0 ? "none: the triangles cover the sphere" : counted(f.boundary, "node"));
  json["fewest_neighbours"] = extreme(f.fewest);
  add("most_neighbours", extreme(f.most), "neighbours",
      fmt::format("{} ({}) to {} ({})", f.fewest.value, place(f.fewest.first), f.most.value,
                  place(f.most.first)));
  add("shortest_arc", extreme(f.shortest), "tightest pair", pair(f.shortest));
  add("mean_arc", f.mean, "mean arc", length(f.mean));
  add("longest_arc", extreme(f.longest), "longest arc", pair(f.longest));
  add("near_duplicates", f.near, "near duplicates",
      fmt::format("{} closer than {} of the mean arc", counted(f.near, "pair"), kNear));
  add("smallest_angle_degrees", extreme(f.sharpest), "smallest angle",
      fmt::format("{:.6g} degrees, at {}", f.sharpest.value, place(f.sharpest.first)));
  for (const files::Duplicate& d : duplicates)
    line("duplicate", fmt::format("{} and {}", nodes.place(d.first), nodes.place(d.node)));
  print(options.json ? json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n' : text);
}

}  // namespace

void add_info(CLI::App& app, Command& chosen) {
  CLI::App* const sub = app.add_subcommand(
      "info", "counts, boundary, duplicates, tightest pair and quality of the triangulation of the nodes");
  const auto options = std::make_shared<InfoOptions>();
  add_input(*sub, options->input);
  sub->add_flag("--json", options->json, "print JSON");
  sub->callback([=, &chosen] { chosen = [=] { info(*options); }; });
}

}  // namespace program
