#include "conversion/kaist_stream.hpp"

#include <algorithm>
#include <utility>

#include "conversion/message_scans.hpp"

namespace pcrb_tools {
namespace {

/// How far the two streams may be apart, at least.
constexpr pcrb::Stamp kPatience = 5 * pcrb::kSecond;

}  // namespace

KaistStream::KaistStream(const KaistFrames& frames, const KaistRequest& request,
                         const std::string& sequence, const std::string& identity,
                         Conversion& conversion)
    : frames_(frames),
      request_(request),
      identity_(identity),
      conversion_(conversion),
      gate_(frames, request, sequence, conversion),
      pairer_(std::max(kPatience, 2 * request.options.max_pair_gap)) {}

void KaistStream::addLeft(const Message& message) {
  convert(pairer_.addLeft(stampOf(message->header.stamp), message));
}

void KaistStream::addRight(const Message& message) {
  convert(pairer_.addRight(stampOf(message->header.stamp), message));
}

void KaistStream::finish() { convert(pairer_.flush()); }

void KaistStream::convert(const std::vector<Pairer::Pair>& pairs) {
  for (const auto& pair : pairs) {
    const auto right_stamp = pair.right ? std::optional(pair.right->first) : std::nullopt;
    const auto admitted = gate_.admit(pair.left_stamp, right_stamp);
    if (!admitted || !conversion_.wants(admitted->cloud_name, identity_ + admitted->origin)) {
      continue;
    }
    conversion_.add(admitted->cloud_name, [&frames = frames_, &request = request_, left = pair.left,
                                           right = pair.right->second, admitted = *admitted] {
      const std::string name = ' ' + admitted.cloud_name;
      return mergePair(frames, admitted, scanOf(*left, request.origin, request.left_topic + name),
                       scanOf(*right, request.origin, request.right_topic + name));
    });
  }
}

}  // namespace pcrb_tools
