// What several figures share.
#pragma once

#include <memory>

#include "limn/limn.h"

namespace limn::figures {

/// The skies of Shirley's first and second book.
inline constexpr Background kFirstBookSky = Background::gradient({1, 1, 1}, {0.5, 0.7, 1});
inline constexpr Background kSecondBookSky = Background::constant({0.7, 0.8, 1});

std::shared_ptr<const Material> matte(const Color& albedo);
/// Dark green and light grey cells.
std::shared_ptr<const Material> checkered(double cell);
/// Grey marble with the lattice of data/perlin_lattice.txt.
std::shared_ptr<const Material> marbled(double scale);

/// A ball on a checkered ground that fills the lower half (figures 3, 4, 10, 11).
Scene ball_on_checker(std::shared_ptr<const Material> ball);
Camera ball_on_checker_camera();

/// The empty Cornell box: five walls and a light in a corner-and-edges rectangle under the ceiling (figures 15, 16).
Scene cornell_room(std::shared_ptr<const Hittable> light);
Camera cornell_camera();
/// The tall box and the short one, turned and put in their places.
std::shared_ptr<const Hittable> tall_box(const std::shared_ptr<const Material>& material);
std::shared_ptr<const Hittable> short_box(const std::shared_ptr<const Material>& material);

}  // namespace limn::figures
