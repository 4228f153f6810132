#include <algorithm>
#include <cmath>
#include <iterator>

#include "ground_truth/ground_truth_tool.hpp"
#include "ground_truth/svg_text.hpp"

namespace pcrb_tools {
namespace {

constexpr double kWidth = 360.0;  // of a panel, px
constexpr double kHeight = 220.0;
constexpr double kLeft = 40.0;  // of its axes within it
constexpr double kRight = 345.0;
constexpr double kTop = 30.0;
constexpr double kBottom = 175.0;
constexpr std::size_t kColumns = 2;
constexpr std::size_t kBins = 24;

/// The histogram of one sequence, in its own coordinates.
class Panel {
 public:
  explicit Panel(const SequenceAccuracy& sequence) : sequence_(sequence), kept_(kBins, 0.0) {
    const auto& values = sequence.pairs.misalignments;
    const double largest = *std::max_element(values.begin(), values.end());
    const pcrb::Statistics& statistics = sequence.accuracy.kept;
    end_ = std::min(largest, statistics.mean + 6.0 * statistics.stddev) * 1.02;
    if (!(end_ > 0.0)) end_ = 1.0;
    outliers_ = kept_;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double place =
          std::min(values[i] / end_ * kBins, kBins - 0.5);  // the last has the rest
      auto& bins = sequence.accuracy.is_outlier[i] ? outliers_ : kept_;
      bins[static_cast<std::size_t>(place)] += 1.0;
    }
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      top_ = std::max(top_, kept_[bin] + outliers_[bin]);
    }
  }

  std::string svg() const {
    const pcrb::Statistics& kept = sequence_.accuracy.kept;
    std::string text;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      text += bar(bin, 0.0, kept_[bin], "kept") + bar(bin, kept_[bin], outliers_[bin], "outlier");
    }
    if (kept.stddev > 0.0) text += gaussian();
    text += line(x(kept.mean), kBottom, x(kept.mean), kTop, "mean");
    text +=
        line(kLeft, kBottom, kRight, kBottom, "axis") + line(kLeft, kBottom, kLeft, kTop, "axis");
    text += label(kLeft, kBottom + 16, "middle", "0");
    text += label(kRight, kBottom + 16, "end", pcrb::formatFixed(end_, 3) + " m");
    text += label(kLeft - 5, kTop + 6, "end", pcrb::formatFixed(top_, 0));
    text += label((kLeft + kRight) / 2, kTop - 12, "middle",
                  sequence_.data_set + " / " + sequence_.sequence);
    text += label((kLeft + kRight) / 2, kBottom + 34, "middle",
                  pcrb::formatFixed(kept.mean, 3) + " ± " + pcrb::formatFixed(kept.stddev, 3) +
                      " m, " + std::to_string(kept.count) + " pairs, " +
                      std::to_string(sequence_.accuracy.outliers) + " outliers");
    return text;
  }

 private:
  double x(double value) const { return kLeft + value / end_ * (kRight - kLeft); }
  double y(double count) const { return kBottom - count / top_ * (kBottom - kTop); }

  std::string bar(std::size_t bin, double from, double count, const std::string& style) const {
    if (count == 0.0) return {};
    const double width = (kRight - kLeft) / kBins;
    return "<rect x='" + px(kLeft + width * static_cast<double>(bin)) + "' y='" +
           px(y(from + count)) + "' width='" + px(width - 1.0) + "' height='" +
           px(y(from) - y(from + count)) + "' class='" + style + "'/>\n";
  }

  /// As many pairs as were kept, with their mean and standard deviation.
  std::string gaussian() const {
    constexpr int kSteps = 120;
    const pcrb::Statistics& kept = sequence_.accuracy.kept;
    const double scale =
        static_cast<double>(kept.count) * (end_ / kBins) / (kept.stddev * std::sqrt(2.0 * M_PI));
    std::string points;
    for (int i = 0; i <= kSteps; ++i) {
      const double value = end_ * i / kSteps;
      const double z = (value - kept.mean) / kept.stddev;
      points += px(x(value)) + "," + px(y(scale * std::exp(-0.5 * z * z))) + " ";
    }
    return "<polyline points='" + points + "' class='gaussian'/>\n";
  }

  const SequenceAccuracy& sequence_;
  std::vector<double> kept_;
  std::vector<double> outliers_;
  double end_ = 1.0;  // m, of the horizontal axis
  double top_ = 1.0;  // pairs, of the vertical one
};

}  // namespace

std::string plotSvg(const std::vector<SequenceAccuracy>& sequences) {
  std::vector<SequenceAccuracy> known;
  std::copy_if(sequences.begin(), sequences.end(), std::back_inserter(known),
               [](const SequenceAccuracy& sequence) { return sequence.isKnown(); });
  const std::size_t columns = std::min(kColumns, known.size());
  const std::size_t rows = (known.size() + kColumns - 1) / kColumns;
  std::string text =
      beginSvg(kWidth * static_cast<double>(columns), kHeight * static_cast<double>(rows),
               ".kept{fill:#4a7ab5}.outlier{fill:#d9822b}.mean{stroke:#b02020;stroke-dasharray:4 3}"
               ".axis{stroke:#333}.gaussian{fill:none;stroke:#222;stroke-width:1.3}");
  for (std::size_t i = 0; i < known.size(); ++i) {
    const std::size_t column = i % kColumns;
    const std::size_t row = i / kColumns;
    const double left = kWidth * static_cast<double>(column);
    const double top = kHeight * static_cast<double>(row);
    text += movedGroup(left, top, Panel(known[i]).svg());
  }
  return text + "</svg>\n";
}

}  // namespace pcrb_tools
