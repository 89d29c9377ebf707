#include "pictures/histograms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "files/measures.h"
#include "geometry/measures.h"
#include "pictures/legend.h"
#include "pictures/scale.h"
#include "pictures/sheet.h"
#include "stripack/list_queries.h"

namespace pictures {
namespace {

/// Counts whose largest ratio exceeds this are shown on a logarithmic axis: that of five neighbours is
/// some 12.
constexpr std::size_t kMuch = 20;
constexpr const char* kBars = "#31688e";

/// A histogram across the full width of its panel.
class Panel {
 public:
  Panel(Sheet& sheet, double left, double top) : sheet_(sheet), left_(left), top_(top) {}

  /// `factor`: unit in which the values are printed.
  void titles(const std::string& title, const std::vector<double>& values, double factor) {
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    sheet_.text({left_, top_ + 12}, 14, Anchor::start, title);
    sheet_.text(
        {left_, top_ + 30}, 12, Anchor::start,
        fmt::format("min {}, median {}, max {}", short_number(sorted.front() / factor),
                    short_number(sorted[sorted.size() / 2] / factor), short_number(sorted.back() / factor)),
        kGrey);
  }

  /// `gap`: space between two bars, as a fraction of their width.
  void bars(const std::vector<std::size_t>& counts, double gap) {
    const double most = static_cast<double>(*std::max_element(counts.begin(), counts.end()));
    const double step = std::max(1.0, round_step(most, 4)), steps = std::ceil(most / step - 1e-9);
    std::vector<double> ticks;
    for (double k = 0; k <= steps; ++k) ticks.push_back(k * step);
    bars(counts, gap, ticks, [&](double count) { return count / (step * steps); });
  }

  /// With a logarithmic axis, from 1/2, so that a bar of 1 is seen, and the counts above the bars.
  void logarithmic_bars(const std::vector<std::size_t>& counts, double gap) {
    const double most = static_cast<double>(*std::max_element(counts.begin(), counts.end()));
    std::vector<double> ticks{1};
    while (ticks.back() < 2 * most) ticks.push_back(10 * ticks.back());
    const auto height = [&](double count) { return std::log(2 * count) / std::log(2 * ticks.back()); };
    bars(counts, gap, ticks, height);
    const double bar = kWide / static_cast<double>(counts.size());
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const double y = bottom() - kHigh * height(static_cast<double>(counts[i])) - 4;
      if (counts[i] > 0)
        sheet_.text_if_free({left_ + bar * (static_cast<double>(i) + 0.5), y}, kTickLabels, Anchor::middle,
                            grouped(counts[i]));
    }
  }

  void tick(double t, const std::string& label) {
    const double x = left_ + t * kWide;
    sheet_.rectangle(x - 0.5, bottom(), 1, 5, kGrey);
    sheet_.text({x, bottom() + 18}, kTickLabels, Anchor::middle, label);
  }

  static constexpr double kWide = 310, kHigh = 170, kAll = kHigh + 90;

 private:
  /// `height`: of a count, as a fraction of the panel's.
  template <class Height>
  void bars(const std::vector<std::size_t>& counts, double gap, const std::vector<double>& ticks,
            const Height& height) {
    const double bar = kWide / static_cast<double>(counts.size());
    sheet_.rectangle(left_, bottom() - kHigh, kWide, kHigh, "none", "none", Sheet::kDrawing);
    for (const double tick : ticks) {
      const double y = bottom() - kHigh * height(tick);
      sheet_.rectangle(left_, y - 0.4, kWide, 0.8, "#dddddd");
      sheet_.text({left_ - 6, y + 4}, kTickLabels, Anchor::end,
                  grouped(static_cast<std::size_t>(std::lround(tick))));
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const double high = kHigh * height(static_cast<double>(counts[i]));
      if (counts[i] > 0)
        sheet_.rectangle(left_ + bar * (static_cast<double>(i) + gap / 2), bottom() - high, bar * (1 - gap),
                         high, kBars);
    }
    sheet_.rectangle(left_, bottom(), kWide, 1, kGrey);
  }

  double bottom() const { return top_ + 44 + kHigh; }
  Sheet& sheet_;
  double left_, top_;
};

/// `unit` is printed after the power of ten of the ticks.
void draw(Panel panel, const std::string& title, const std::string& unit, const std::vector<double>& values,
          bool linear = false) {
  constexpr std::size_t kBins = 40;
  const Scale scale = Scale::fitting(values, 5, Panel::kWide, kTickLabels, linear);
  std::vector<std::size_t> counts(kBins);
  for (const double value : values)
    ++counts[std::min(kBins - 1, static_cast<std::size_t>(scale(value) * kBins))];
  panel.titles(fmt::format("{}, {}{}", title, scale.name_of_factor(), unit), values, scale.factor());
  panel.bars(counts, 0.08);
  for (const Scale::Tick& tick : scale.ticks()) panel.tick(scale(tick.value), tick.label);
}

void draw_degrees(Panel panel, const std::vector<double>& degrees) {
  const auto [low, high] = std::minmax_element(degrees.begin(), degrees.end());
  const auto first = static_cast<std::size_t>(*low), last = static_cast<std::size_t>(*high);
  std::vector<std::size_t> counts(last - first + 1);
  for (const double degree : degrees) ++counts[static_cast<std::size_t>(degree) - first];
  panel.titles("neighbours of a node", degrees, 1);
  std::vector<std::size_t> there = counts;
  there.erase(std::remove(there.begin(), there.end(), 0), there.end());
  const auto [fewest, most] = std::minmax_element(there.begin(), there.end());
  if (*most > kMuch * *fewest)
    panel.logarithmic_bars(counts, 0.3);
  else
    panel.bars(counts, 0.3);
  const std::size_t step = 1 + counts.size() / 14;
  for (std::size_t i = 0; i < counts.size(); i += step)
    panel.tick((static_cast<double>(i) + 0.5) / static_cast<double>(counts.size()),
               std::to_string(first + i));
}

}  // namespace

std::string histograms(const files::Mesh& mesh, const std::string& title, double width) {
  const pstripack::Directions nodes(mesh.points.data(), mesh.points.size());
  const auto at = [&](std::int32_t node) { return pstripack::direction_of(nodes, node - 1); };
  std::vector<double> angles, lengths, areas, degrees;
  const std::vector<std::int32_t> triangles = files::triangles_of(mesh);
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const pstripack::Direction a = at(triangles[t]), b = at(triangles[t + 1]), c = at(triangles[t + 2]);
    const auto [x, y, z] = angles_of(a, b, c).at;
    angles.push_back(std::min({x, y, z}) * files::kRadian);
    areas.push_back(triangle_area(a, b, c) * files::kEarthRadius * files::kEarthRadius);
  }
  const pstripack::ListReader<std::int32_t> reader(mesh.lists());
  for (std::int32_t node = 1; node <= reader.size(); ++node) {
    double degree = 0;
    std::int32_t slot = reader.last_slot(node);
    do {
      ++degree;
      if (const std::int32_t neighbour = reader.neighbour(slot); neighbour > node)
        lengths.push_back(arc_length(at(node), at(neighbour)) * files::kRadian);
      slot = reader.next(slot);
    } while (slot != reader.last_slot(node));
    degrees.push_back(degree);
  }

  Sheet sheet(width, kWidth);
  const double top = sheet.title(title) + 6, left = 72, right = 462;
  draw({sheet, left, top}, "smallest angle of a triangle", "degrees", angles, true);
  draw({sheet, right, top}, "length of an arc", "degrees", lengths);
  draw({sheet, left, top + Panel::kAll}, "area of a triangle", "km²", areas);
  draw_degrees({sheet, right, top + Panel::kAll}, degrees);
  return sheet.svg(top + 2 * Panel::kAll);
}

}  // namespace pictures
