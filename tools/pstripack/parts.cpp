#include "pstripack/parts.h"

#include <cstdint>
#include <optional>

#include "parallel/parcels.h"
#include "scvt/caller_agreement.h"

namespace program {

using pstripack::Communicator;
using pstripack::scvt::in_agreement_with_caller;
using pstripack::scvt::sum_before;
using pstripack::scvt::sum_of_all;

namespace {

/// The rows of this rank among those of all ranks. Collective.
files::Share share_of(Communicator& ranks, std::size_t here) {
  const std::int64_t before = sum_before(ranks, here);
  return {static_cast<std::size_t>(before), static_cast<std::size_t>(sum_of_all(ranks, here))};
}

}  // namespace

files::MeshPart part_of(Communicator& ranks, const pstripack::scvt::Neighbourhood& nodes) {
  files::MeshPart part;
  const pstripack::scvt::NeighbourLists& stars = nodes.stars;
  const auto number = [&](std::int32_t place) { return nodes.numbers[place - 1]; };
  in_agreement_with_caller(ranks, [&] {
    part.nodes = stars.count;
    for (std::size_t i = 0; i < stars.count; ++i) {
      const std::size_t begin = stars.begin_of(i), end = stars.end_of(i);
      const auto here = static_cast<std::int32_t>(i) + 1;
      part.degrees.push_back(static_cast<double>(end - begin));
      for (std::size_t k = begin; k < end; ++k) {
        const std::int32_t b = stars.neighbour[k], c = stars.neighbour[k + 1 < end ? k + 1 : begin];
        if (number(b) > number(here) && number(c) > number(here))
          part.corner.insert(part.corner.end(), {here, b, c});
      }
    }
    part.points.assign(nodes.points, nodes.points + nodes.known);
    part.numbers.assign(nodes.numbers, nodes.numbers + nodes.known);
  });
  part.share_of_nodes = share_of(ranks, part.nodes);
  part.share_of_triangles = share_of(ranks, part.corner.size() / 3);
  return part;
}

files::MeshPart part_of(Communicator& ranks, const std::vector<files::Point>& nodes) {
  files::MeshPart part;
  in_agreement_with_caller(ranks, [&] { part.points = nodes; });
  part.nodes = nodes.size();
  part.share_of_nodes = share_of(ranks, part.nodes);
  return part;
}

std::vector<files::Point> on_rank_0(Communicator& ranks, const std::vector<files::Point>& nodes) {
  pstripack::Parcels parcels;
  in_agreement_with_caller(ranks, [&] {
    std::vector<std::vector<files::Point>> to(static_cast<std::size_t>(ranks.size()));
    to[0] = nodes;
    parcels = pstripack::packed(to);
  });
  parcels = ranks.exchange(parcels);
  std::vector<files::Point> all;
  in_agreement_with_caller(ranks, [&] {
    const pstripack::Items<files::Point> items(parcels);
    all.assign(items.begin(), items.end());
  });
  return all;
}

void write_parts(Communicator& ranks, const std::string& name, files::Format format,
                 const files::MeshPart& part) {
  std::optional<files::OutputFile> file;  // on rank 0
  pstripack::Smallest first;              // the lowest rank with nodes: it begins the sections
  in_agreement_with_caller(
      ranks,
      [&] {
        if (ranks.rank() == 0) file.emplace(name);
        if (part.nodes > 0) first.value = ranks.rank();
      },
      first);
  const std::string mine = file ? file->path() : "";
  const pstripack::Parcels paths = ranks.all_gather(mine.data(), mine.size());
  const std::string path(reinterpret_cast<const char*>(paths.bytes.data()), paths.begin.back());
  for (int section = 0; section < files::sections_of(format); ++section)
    for (int turn = 0; turn < ranks.size(); ++turn)
      in_agreement_with_caller(ranks, [&] {
        if (turn != ranks.rank() || part.nodes == 0) return;
        const bool is_begun = section > 0 || turn > first.value;
        files::write_part(files::OutputFile(name, path, is_begun), format, part, section);
      });
  in_agreement_with_caller(ranks, [&] {
    if (file) file->commit();
  });
}

}  // namespace program
