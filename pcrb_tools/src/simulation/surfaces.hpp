#pragma once

#include "simulation/shape.hpp"

namespace pcrb_tools::simulation {

// Colours and reflectivities (near infrared) of the scenes' materials.

inline const Surface kPlaster{{0.88F, 0.86F, 0.80F}, 0.70F};
inline const Surface kCeiling{{0.95F, 0.95F, 0.93F}, 0.80F};
inline const Surface kParquet{{0.62F, 0.43F, 0.26F}, 0.45F};
inline const Surface kCarpet{{0.38F, 0.40F, 0.46F}, 0.35F};
inline const Surface kWood{{0.55F, 0.36F, 0.20F}, 0.50F};
inline const Surface kLightWood{{0.80F, 0.66F, 0.46F}, 0.55F};
inline const Surface kWhitePaint{{0.92F, 0.92F, 0.92F}, 0.80F};
inline const Surface kRedFabric{{0.62F, 0.16F, 0.14F}, 0.45F};
inline const Surface kBlueFabric{{0.16F, 0.26F, 0.52F}, 0.35F};
inline const Surface kGreyFabric{{0.46F, 0.46F, 0.48F}, 0.40F};
inline const Surface kSteel{{0.66F, 0.68F, 0.70F}, 0.55F};
inline const Surface kBlackPlastic{{0.10F, 0.10F, 0.11F}, 0.12F};
/// Screens and window panes send no light back to where it came from: sensors see nothing there.
inline const Surface kGlass{{0.06F, 0.08F, 0.10F}, 0.0F};
inline const Surface kSkin{{0.80F, 0.60F, 0.50F}, 0.55F};
inline const Surface kTeddy{{0.64F, 0.44F, 0.22F}, 0.50F};
inline const Surface kLeaf{{0.22F, 0.42F, 0.14F}, 0.55F};
inline const Surface kAutumnLeaf{{0.66F, 0.42F, 0.12F}, 0.55F};
inline const Surface kBark{{0.34F, 0.25F, 0.18F}, 0.35F};
inline const Surface kForestFloor{{0.36F, 0.30F, 0.18F}, 0.40F};
inline const Surface kSand{{0.76F, 0.60F, 0.40F}, 0.50F};
inline const Surface kRock{{0.50F, 0.40F, 0.34F}, 0.40F};
inline const Surface kAsphalt{{0.24F, 0.24F, 0.25F}, 0.20F};
inline const Surface kPavement{{0.58F, 0.57F, 0.54F}, 0.35F};
inline const Surface kGrass{{0.30F, 0.50F, 0.18F}, 0.50F};
inline const Surface kBrick{{0.60F, 0.32F, 0.24F}, 0.40F};
inline const Surface kRender{{0.85F, 0.80F, 0.68F}, 0.65F};
inline const Surface kRoofTile{{0.50F, 0.22F, 0.16F}, 0.35F};
inline const Surface kRubber{{0.08F, 0.08F, 0.08F}, 0.08F};
inline const Surface kSilverPaint{{0.72F, 0.73F, 0.75F}, 0.60F};
inline const Surface kRedPaint{{0.66F, 0.10F, 0.10F}, 0.50F};
inline const Surface kDarkPaint{{0.12F, 0.14F, 0.20F}, 0.15F};

}  // namespace pcrb_tools::simulation
