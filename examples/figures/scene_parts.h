// Materials, objects and cameras that several figures use.
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
/// Returns a checkerboard of dark green and light grey cells with sides of length `cell`.
std::shared_ptr<const Material> checkered(double cell);
/// Returns grey marble with the lattice of data/perlin_lattice.txt and `scale` cells per world unit.
std::shared_ptr<const Material> marbled(double scale);

/// Returns a ball on a checkered ground (figures 3, 4, 10, 11).
Scene ball_on_checker(std::shared_ptr<const Material> ball);
Camera ball_on_checker_camera();

/// Returns the balls of figures 1 and 2 on a checkered ground. `fresnel` is used for balls of glass.
Scene balls_on_checker(const std::vector<BouncingSphere>& balls, Fresnel fresnel);

/// Returns a ball on the ground, both of the material `stone`, with a spherical and a rectangular lamp (figure 12).
Scene stone_under_lamps(const std::shared_ptr<const Material>& stone);

/// Returns a glass ball with a bubble in it, a matte ball and a metal ball (figures 13, 17, 18).
Scene three_balls(const std::shared_ptr<const Material>& glass, std::shared_ptr<const Material> metal);

/// Returns the empty Cornell box: five walls and the given light (figures 15, 16).
Scene cornell_room(std::shared_ptr<const Hittable> light);
/// Returns the light of figure 15, a rectangle under the ceiling.
std::shared_ptr<const Hittable> cornell_lamp();
Camera cornell_camera();
/// Return the tall and the short box of figure 15, at their places in the room.
std::shared_ptr<const Hittable> tall_box(const std::shared_ptr<const Material>& material);
std::shared_ptr<const Hittable> short_box(const std::shared_ptr<const Material>& material);

}  // namespace limn::figures
