#include "bench/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "limn/limn.h"

namespace limn::bench {
namespace {

std::size_t scaled(double count, double scale) { return static_cast<std::size_t>(std::max(1.0, count * scale)); }

std::shared_ptr<const Mesh> mesh_of(MeshData data) { return std::make_shared<Mesh>(std::move(data), nullptr); }

struct Wave {
    Vec3 frequency;
    double phase, height;
};

// Returns the point in the given unit direction of a ball with hills: its radius is 1 plus a sum of waves.
Vec3 on_hills(const Vec3& direction) {
    static const std::array<Wave, 32> waves = [] {
        std::array<Wave, 32> made;
        for (std::size_t i = 0; i < made.size(); ++i) {
            const auto u = random_numbers(2, i);
            const double frequency = 3 * std::pow(1.17, static_cast<double>(i));
            made[i] = {frequency * sample_uniform_sphere(u(0), u(1)), 2 * std::numbers::pi * u(2), 0.12 / frequency};
        }
        return made;
    }();
    double r = 1;
    for (const Wave& w : waves) r += w.height * std::sin(dot(w.frequency, direction) + w.phase);
    return r * direction;
}

// Returns a ball with hills. Its mesh is a cube whose faces are divided into squares and projected to the ball. Faces
// compute the points of a common edge from the same whole numbers, so the surface is closed.
Geometry displaced_sphere(double scale) {
    const auto cuts = static_cast<std::uint32_t>(std::max(1.0, std::round(std::sqrt(2e6 * scale / 12))));
    MeshData data;
    for (int face = 0; face < 6; ++face) {
        // Add the vertices of the face.
        const auto first = static_cast<std::uint32_t>(data.vertices.size());
        const int axis = face / 2, side = face % 2;
        for (std::uint32_t j = 0; j <= cuts; ++j) {
            for (std::uint32_t i = 0; i <= cuts; ++i) {
                // Use tan() of equal steps, which gives squares of similar size on the ball.
                const auto along = [cuts](std::uint32_t k) {
                    return std::tan(std::numbers::pi / 4 * (2 * static_cast<double>(k) - cuts) / cuts);
                };
                std::array<double, 3> p{};
                p[static_cast<std::size_t>(axis)] = along(side == 1 ? cuts : 0);
                p[static_cast<std::size_t>((axis + 1) % 3)] = along(i);
                p[static_cast<std::size_t>((axis + 2) % 3)] = along(j);
                data.vertices.push_back(to_float3(on_hills(normalize(Vec3(p[0], p[1], p[2])))));
            }
        }
        // Add its triangles, two for each square, counter-clockwise seen from outside.
        for (std::uint32_t j = 0; j < cuts; ++j) {
            for (std::uint32_t i = 0; i < cuts; ++i) {
                const std::uint32_t a = first + j * (cuts + 1) + i, b = a + 1, c = a + cuts + 1, d = c + 1;
                data.triangles.push_back(side == 0 ? Index3{a, d, b} : Index3{a, b, d});
                data.triangles.push_back(side == 0 ? Index3{a, c, d} : Index3{a, d, c});
            }
        }
    }
    return {.name = "displaced sphere", .mesh = mesh_of(std::move(data))};
}

// Adds a triangle whose vertices are random points of a sphere of radius `size`. u(k) is random number k. The function
// uses six, from `dimension` on.
void add_triangle(MeshData& data, const Vec3& center, double size, const auto& u, std::uint64_t dimension) {
    const auto first = static_cast<std::uint32_t>(data.vertices.size());
    for (std::uint64_t k = dimension; k < dimension + 6; k += 2)
        data.vertices.push_back(to_float3(center + size * sample_uniform_sphere(u(k), u(k + 1))));
    data.triangles.push_back({first, first + 1, first + 2});
}

// Returns triangles with random orientations at random points of the unit cube. Their size is proportional to the mean
// distance between neighbours, so that the overlap does not depend on their number.
Geometry soup(double scale) {
    const std::size_t count = scaled(1e6, scale);
    const double size = 0.03 / std::cbrt(scale);
    MeshData data;
    for (std::size_t i = 0; i < count; ++i) {
        const auto u = random_numbers(3, i);
        add_triangle(data, {u(0), u(1), u(2)}, size, u, 3);
    }
    return {.name = "soup", .mesh = mesh_of(std::move(data))};
}

// Returns spheres on the ground, at scale 1 as many as in the last picture of Shirley, Ray Tracing in One Weekend.
Geometry spheres(double scale) {
    Geometry g{.name = "spheres"};
    g.balls.push_back({{0, -1000, 0}, 1000});
    for (const double x : {-4.0, 0.0, 4.0}) g.balls.push_back({{x, 1, 0}, 1});
    const int reach = std::max(1, static_cast<int>(11 * std::sqrt(scale)));
    for (int i = -reach; i < reach; ++i) {
        for (int j = -reach; j < reach; ++j) {
            const auto u = random_numbers(4, (i + reach) * 2 * reach + j + reach);
            g.balls.push_back({to_float32(Point3{i + 0.9 * u(0), 0.2, j + 0.9 * u(1)}), to_float32(0.2)});
        }
    }
    g.camera = Camera{.look_from = {13, 2, 3}, .vertical_fov = 20};
    g.light = Point3{-5, 20, 10};
    g.t_min = 0x1p-10;
    return g;
}

// Adds the six quads of a box with one corner at the origin, transformed by `place`.
void add_box(Geometry& g, const Vec3& size, const Transform& place) {
    const auto add = [&](const Point3& corner, const Vec3& u, const Vec3& v) {
        g.quads.push_back({to_float32(transform_point(place, corner)), to_float32(transform_vector(place, u)),
                           to_float32(transform_vector(place, v))});
    };
    const Vec3 edges[] = {{size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}};
    for (std::size_t i = 0; i < 3; ++i) {
        add(Point3{}, edges[(i + 1) % 3], edges[i]);
        add(Point3{} + size, -edges[i], -edges[(i + 1) % 3]);
    }
}

// Returns the Cornell box: five walls, a lamp and two boxes, 18 quads at any scale.
Geometry cornell_box() {
    Geometry g{.name = "cornell box"};
    const Vec3 x{555, 0, 0}, y{0, 555, 0}, z{0, 0, 555};
    g.quads = {{{555, 0, 0}, y, z}, {{0, 0, 0}, y, z},   {{0, 0, 0}, x, z},
               {{0, 555, 0}, x, z}, {{0, 0, 555}, x, y}, {{343, 554, 332}, {-130, 0, 0}, {0, 0, -105}}};
    add_box(g, {165, 330, 165}, Transform::translate({265, 0, 295}) * Transform::rotate_y(15));
    add_box(g, {165, 165, 165}, Transform::translate({130, 0, 65}) * Transform::rotate_y(-18));
    g.camera = Camera{.look_from = {278, 278, -800}, .look_at = {278, 278, 0}, .vertical_fov = 40};
    g.light = Point3{278, 550, 279.5};
    return g;
}

// Returns a tree of height 1 with `count` triangles: a trunk of long triangles and a crown of leaves.
MeshData tree(std::size_t count) {
    constexpr std::uint32_t kSides = 16;
    MeshData data;
    data.vertices.push_back({0, 1, 0});
    for (std::uint32_t i = 0; i < kSides; ++i) {
        const double angle = 2 * std::numbers::pi * i / kSides;
        data.vertices.push_back(to_float3(Vec3{0.03 * std::cos(angle), 0, 0.03 * std::sin(angle)}));
        data.triangles.push_back({0, 1 + (i + 1) % kSides, 1 + i});
    }
    for (std::size_t i = kSides; i < count; ++i) {
        const auto u = random_numbers(5, i);
        const Vec3 inside = sample_uniform_ball(u(0), u(1), u(2));
        add_triangle(data, {0.3 * inside.x, 0.65 + 0.35 * inside.y, 0.3 * inside.z}, 0.015, u, 3);
    }
    return data;
}

// Returns instances of a tree on a grid, each with a random offset, rotation and size.
Geometry forest(double scale) {
    Geometry g{.name = "forest", .mesh = mesh_of(tree(scaled(1e4, scale)))};
    const int side = std::max(1, static_cast<int>(std::round(100 * std::sqrt(scale))));
    for (int i = 0; i < side * side; ++i) {
        const auto u = random_numbers(6, i);
        const double size = 0.7 + 0.6 * u(0);
        Transform place = Transform::translate({0.5 * (i % side + u(1)), 0, 0.5 * (i / side + u(2))}) *
                          Transform::rotate_y(360 * u(3)) * Transform::scale(size, size, size);
        for (auto& row : place.rows)
            for (double& entry : row) entry = to_float32(entry);
        g.places.push_back(place);
    }
    g.camera = Camera{.look_from = {0.25 * side, 0.1 * side + 1, 0.7 * side}, .look_at = {0.25 * side, 0, 0.3 * side}};
    return g;
}

}  // namespace

const std::vector<std::string>& scene_names() {
    static const std::vector<std::string> names{"sphere", "soup", "spheres", "cornell", "forest"};
    return names;
}

Geometry make_scene(const std::string& name, double scale) {
    if (name == "sphere") return displaced_sphere(scale);
    if (name == "soup") return soup(scale);
    if (name == "spheres") return spheres(scale);
    if (name == "cornell") return cornell_box();
    if (name == "forest") return forest(scale);
    throw ArgumentError("'" + name + "' is not the name of a scene");
}

Geometry load_scene(const std::string& path) {
    const Model model = load_obj(path, {.textures = false});  // has one mesh
    return {.name = std::filesystem::path(path).filename().string(), .mesh = model.meshes.front()};
}

Scene describe(const Geometry& geometry) {
    Scene scene;
    scene.name = geometry.name;
    if (geometry.mesh && geometry.places.empty()) scene.add(geometry.mesh);
    for (const Transform& place : geometry.places) scene.add(std::make_shared<Instance>(geometry.mesh, place));
    for (const Ball& ball : geometry.balls) scene.add(std::make_shared<Sphere>(ball.center, ball.radius, nullptr));
    for (const Parallelogram& q : geometry.quads)
        scene.add(std::make_shared<Quad>(q.corner, q.edge_u, q.edge_v, nullptr));
    return scene;
}

std::size_t stored_primitives(const Geometry& geometry) {
    const std::size_t triangles = geometry.mesh ? geometry.mesh->data().triangles.size() : 0;
    return triangles + geometry.places.size() + geometry.balls.size() + geometry.quads.size();
}

}  // namespace limn::bench
