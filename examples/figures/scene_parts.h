// Parts that several figures use.
#pragma once

#include <memory>
#include <vector>

#include "figure_data.h"
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

/// Balls of figures 1 and 2 on a checkered ground; `fresnel` is of those of glass.
Scene balls_on_checker(const std::vector<BouncingSphere>& balls, Fresnel fresnel);

/// A ball on a ground, both of stone, lit by a ball and a pane of light in the dark (figure 12).
Scene stone_under_lamps(const std::shared_ptr<const Material>& stone);

/// Glass with a bubble in it, a matte ball and one of metal, next to each other (figures 13, 17, 18).
Scene three_balls(const std::shared_ptr<const Material>& glass, std::shared_ptr<const Material> metal);

/// The empty Cornell box: five walls and a light in a corner-and-edges rectangle under the ceiling (figures 15, 16).
Scene cornell_room(std::shared_ptr<const Hittable> light);
/// The light of figure 15.
std::shared_ptr<const Hittable> cornell_lamp();
Camera cornell_camera();
/// The tall box and the short one, turned and put in their places.
std::shared_ptr<const Hittable> tall_box(const std::shared_ptr<const Material>& material);
std::shared_ptr<const Hittable> short_box(const std::shared_ptr<const Material>& material);

}  // namespace limn::figures
