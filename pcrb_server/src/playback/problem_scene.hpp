#pragma once

#include <string>

#include "playback/scene_frames.hpp"
#include "server/problem_poser.hpp"

namespace pcrb {

/// What scenes of problems and of results have in common: the target, and the source as perturbed,
/// both in the map's frame, with tf and a text above the source.
///
/// @param show_target  false where the scene before has shown it.
Scene problemScene(const PosedProblem& posed, const ros::Time& stamp, bool show_target,
                   SceneFrames& frames, const ServerParameters& parameters);

/// Adds a text above where T_map_source puts the source's centroid.
void addText(Scene& scene, const PosedProblem& posed, const Transform& T_map_source,
             const std::string& text, const std::string& map_frame);

}  // namespace pcrb
