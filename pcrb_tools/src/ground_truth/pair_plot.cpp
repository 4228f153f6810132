#include <algorithm>
#include <iterator>
#include <vector>

#include "ground_truth/ground_truth_tool.hpp"
#include "ground_truth/svg_text.hpp"

namespace pcrb_tools {
namespace {

constexpr double kPanelWidth = 300.0;  // px
constexpr double kPanelHeight = 190.0;
constexpr double kAxisLeft = 44.0;  // of the axes within a panel
constexpr double kAxisRight = 288.0;
constexpr double kAxisTop = 34.0;
constexpr double kAxisBottom = 158.0;

/// One quantity of a sequence's pairs, in the order of the pairs.
struct Quantity {
  std::string name;
  std::vector<double> values;
  pcrb::Statistics statistics;
};

/// Those that have values where the pairs' poses are known.
std::vector<Quantity> quantitiesOf(const SequenceAccuracy& sequence) {
  const PairFile& pairs = sequence.pairs;
  std::vector<double> kept;
  for (std::size_t i = 0; i < pairs.misalignments.size(); ++i) {
    if (!sequence.accuracy.is_outlier[i]) kept.push_back(pairs.misalignments[i]);
  }
  return {{"translation (m)", pairs.translations, sequence.translation},
          {"rotation (°)", pairs.rotations_deg, sequence.rotation_deg},
          {"misalignment (m)", pairs.misalignments, pcrb::describe(pairs.misalignments)},
          {"misalignment without outliers (m)", kept, sequence.accuracy.kept}};
}

/// Pairs on x, the quantity on y, with its mean and the band of ± one standard deviation.
class PairPanel {
 public:
  explicit PairPanel(const Quantity& quantity) : quantity_(quantity) {
    const pcrb::Statistics& s = quantity.statistics;
    top_ = s.mean + s.stddev;
    for (const double value : quantity.values) top_ = std::max(top_, value);
    top_ = top_ > 0.0 ? 1.05 * top_ : 1.0;
  }

  std::string svg() const {
    const pcrb::Statistics& s = quantity_.statistics;
    const double upper = y(s.mean + s.stddev), lower = y(std::max(0.0, s.mean - s.stddev));
    std::string text = "<rect x='" + px(kAxisLeft) + "' y='" + px(upper) + "' width='" +
                       px(kAxisRight - kAxisLeft) + "' height='" + px(lower - upper) +
                       "' class='band'/>\n";
    for (std::size_t i = 0; i < quantity_.values.size(); ++i) {
      text += "<circle cx='" + px(x(i)) + "' cy='" + px(y(quantity_.values[i])) +
              "' r='1.8' class='pair'/>\n";
    }
    text += line(kAxisLeft, y(s.mean), kAxisRight, y(s.mean), "mean");
    text += line(kAxisLeft, kAxisBottom, kAxisRight, kAxisBottom, "axis") +
            line(kAxisLeft, kAxisBottom, kAxisLeft, kAxisTop, "axis");
    text += label(kAxisLeft - 4, kAxisTop + 8, "end", pcrb::formatFixed(top_, 2));
    text += label(kAxisLeft - 4, kAxisBottom, "end", "0");
    text += label(kAxisRight, kAxisBottom + 15, "end",
                  std::to_string(quantity_.values.size()) + " pairs");
    text += label((kAxisLeft + kAxisRight) / 2, kAxisTop - 10, "middle",
                  quantity_.name + ": " + pcrb::formatFixed(s.mean, 3) + " ± " +
                      pcrb::formatFixed(s.stddev, 3));
    return text;
  }

 private:
  double x(std::size_t i) const {
    const double place =
        (static_cast<double>(i) + 0.5) / static_cast<double>(quantity_.values.size());
    return kAxisLeft + place * (kAxisRight - kAxisLeft);
  }
  double y(double value) const { return kAxisBottom - value / top_ * (kAxisBottom - kAxisTop); }

  const Quantity& quantity_;
  double top_ = 1.0;
};

}  // namespace

std::string plotPairsSvg(const std::vector<SequenceAccuracy>& sequences) {
  std::vector<const SequenceAccuracy*> known;
  for (const SequenceAccuracy& sequence : sequences) {
    if (sequence.isKnown()) known.push_back(&sequence);
  }
  constexpr double kHeading = 20.0;  // px
  constexpr double kRow = kPanelHeight + kHeading;
  constexpr std::size_t kPanels = 4;
  std::string text = beginSvg(kPanelWidth * kPanels, kRow * static_cast<double>(known.size()),
                              ".pair{fill:#4a7ab5}.band{fill:#2ca02c;fill-opacity:0.25}"
                              ".mean{stroke:#b02020}.axis{stroke:#333}.heading{font-weight:bold}");
  for (std::size_t row = 0; row < known.size(); ++row) {
    const double top = kRow * static_cast<double>(row);
    text +=
        "<g class='heading'>" +
        label(kAxisLeft, top + 14, "start", known[row]->data_set + " / " + known[row]->sequence) +
        "</g>\n";
    double left = 0.0;
    for (const Quantity& quantity : quantitiesOf(*known[row])) {
      text += movedGroup(left, top + kHeading, PairPanel(quantity).svg());
      left += kPanelWidth;
    }
  }
  return text + "</svg>\n";
}

}  // namespace pcrb_tools
