// SPDX-License-Identifier: Apache-2.0
// Paths traced ahead of the first sample, for what is fitted to a scene: a function of scene, camera and settings.
#pragma once
#include <vector>

#include "offline/light_sample/light_sampler.h"
#include "offline/path/camera_rays.h"
#include "ray_tracing/ray_scene.h"

namespace luciole {

// Up to 512 surface points that the camera sees, and with more than one bounce those that they see.
std::vector<Receiver> probe_receivers(const RayScene& rays, const CameraRays& camera, const PathSettings& settings);

// How much of the correction of colours (colour_correction) to add: what makes the least relMSE at the receivers,
// between 0, where the lights that differ in colour are hidden, and 1.
float colour_share(const RayScene& rays, const LightSet& lights, LightSampler& sampler,
                   const std::vector<Receiver>& receivers);

// How far away the picture's centre is along the view [m]; the scene's size where nothing is.
float distance_at_centre(const RayScene& rays, const Camera& camera);

}  // namespace luciole
