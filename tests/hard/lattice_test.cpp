// Surfaces on whole numbers, and rays that run along their lines or start on them: every equality is exact.
#include "hard/exact_mesh.h"

namespace limn::lattice_test {

using namespace test;

namespace {

constexpr int kTiles = 8;

// The height of a grid's point: flat, or hills of whole numbers.
double height(bool hills, int x, int y) { return hills ? (3 * x * x + 5 * x * y + 2 * y) % 4 : 0; }

MeshData grid(bool hills, const Vec3& corner) {
    MeshData data;
    for (int y = 0; y <= kTiles; ++y)
        for (int x = 0; x <= kTiles; ++x) data.vertices.push_back(to_float3(corner + Vec3(x, y, height(hills, x, y))));
    for (std::uint32_t y = 0; y < kTiles; ++y)
        for (std::uint32_t x = 0; x < kTiles; ++x) {
            const std::uint32_t i = y * (kTiles + 1) + x, j = i + kTiles + 1;
            data.triangles.push_back({i, i + 1, j + 1});
            data.triangles.push_back({i, j + 1, j});
        }
    return data;
}

double whole(Random& random, int first, int last) {
    return first + static_cast<double>(random.index(static_cast<std::size_t>(last - first + 1)));
}

}  // namespace

TEST_CASE("Grids: rays along the axes and diagonals, through vertices and along edges, are decided exactly",
          "[hard][lattice]") {
    Random random(580);
    for (const double shift : {0.0, 4096.0, 1048576.0}) {
        for (const bool hills : {false, true}) {
            const Vec3 corner{shift, -shift, 3};
            const MeshData data = grid(hills, corner);
            const BothWorlds world(std::make_shared<Mesh>(data, nullptr));
            const ExactMesh exact(data);
            Tally tally;
            for (int i = 0; i < count(5e4); ++i) {
                const double half = random.chance(0.5) ? 1 : 0.5;
                const Point3 on = Point3{} + corner + half * Vec3{whole(random, 0, 8), whole(random, 0, 8), 0};
                const Vec3 d{std::copysign(whole(random, -1, 1), random.sign()),
                             std::copysign(whole(random, -1, 1), 1.0),
                             random.chance(0.5) ? -1.0 : whole(random, -2, 2)};
                if (d == Vec3{}) continue;
                const Ray ray = towards(on + Vec3{0, 0, hills ? whole(random, 0, 3) : 0} - 16 * d, d);
                judge_mesh(tally, world, exact, ray);
                if (!hills && d.z != 0) {
                    const auto hit = world.hit(ray, tally);
                    if (!hit || hit->t != 16) tally.fault(ray, "the flat grid is closed");
                }
            }
            check(tally, (hills ? "hills at " : "plane at ") + number(shift));
            CHECK(tally.hits > tally.rays / 4);
        }
    }
}

TEST_CASE("Tiles: a floor of quads on whole numbers has no gaps", "[hard][lattice]") {
    Random random(581);
    auto tiles = std::make_shared<HittableList>();
    for (int x = 0; x < kTiles; ++x)
        for (int y = 0; y < kTiles; ++y)
            tiles->add(std::make_shared<Quad>(Point3(x, y, 0), Vec3{1, 0, 0}, Vec3{0, 1, 0}, nullptr));
    const BothWorlds world(tiles);
    Tally tally;
    for (int i = 0; i < count(1e6); ++i) {
        const bool on_x = random.chance(0.5), on_y = !on_x || random.chance(0.3);
        const Point3 on{on_x ? whole(random, 0, 8) : random.uniform(0, 8),
                        on_y ? whole(random, 0, 8) : random.uniform(0, 8), 0};
        const Vec3 d{on_x ? 0.0 : whole(random, -3, 3), on_y ? 0.0 : whole(random, -3, 3),
                     random.sign()};  // stays in line
        const Ray ray = towards(on - 2 * d, d);
        ++tally.rays, ++tally.judged;
        const auto hit = world.hit(ray, tally);
        // Where the other coordinate was rounded on its way, at the border, the ray may pass outside.
        const Point3 there = ray.at(2);
        const bool inside = there.x >= 1e-9 && there.x <= 8 - 1e-9 && there.y >= 1e-9 && there.y <= 8 - 1e-9;
        if (inside && (!hit || hit->t != 2)) tally.fault(ray, "gap");
    }
    check(tally, "tiles");
}

TEST_CASE("Closed meshes: a ray from a vertex or from the middle of an edge does not hit where it starts",
          "[hard][lattice]") {
    Random random(582);
    for (const double shift : {0.0, 1e3, 1e5}) {
        for (const MeshData& data :
             {icosphere(2, 1, {shift, -shift, 0}), bumpy_sphere(random, 3, 0.2, 1, {shift, 0, 0}),
              cube_mesh(4, {shift, 1, 2}), u_shape()}) {
            const BothWorlds world(std::make_shared<Mesh>(data, nullptr));
            const ExactMesh exact(data);
            Tally tally;
            for (int i = 0; i < count(4e3); ++i) {
                const Index3 t = data.triangles[random.index(data.triangles.size())];
                const Index3 s = data.triangles[random.index(data.triangles.size())];
                const Point3 a = vertex(data, t.a), b = vertex(data, t.b), c = vertex(data, s.c);
                const Point3 start = i % 2 ? a : a + 0.5 * (b - a);  // exact: a sum of two float32
                for (const Vec3 d : {c - start, random.unit(), b - a, cross(b - a, random.unit())}) {
                    if (d == Vec3{}) continue;
                    judge_mesh(tally, world, exact, towards(start, d));
                    judge_mesh(tally, world, exact, {start, d, -0x1p-1074, kInfinity, 0});
                    judge_mesh(tally, world, exact, {start, -d, -kInfinity, 0, 0});
                }
            }
            check(tally, "at " + number(shift));
            CHECK(tally.hits > tally.rays / 2);
        }
    }
}

TEST_CASE("Cubes: rays along the edges and diagonals of whole cubes in a row are decided exactly", "[hard][lattice]") {
    Random random(583);
    MeshData data;
    for (int n = 0; n < 4; ++n) {  // they share faces, which are there twice
        const MeshData cube = cube_mesh(2, {2.0 * n, 0, 0});
        const auto first = static_cast<std::uint32_t>(data.vertices.size());
        data.vertices.insert(data.vertices.end(), cube.vertices.begin(), cube.vertices.end());
        for (const Index3& t : cube.triangles) data.triangles.push_back({first + t.a, first + t.b, first + t.c});
    }
    const BothWorlds world(std::make_shared<Mesh>(data, nullptr));
    const ExactMesh exact(data);
    Tally tally;
    for (int i = 0; i < count(1e5); ++i) {
        const Point3 on{whole(random, 0, 8), whole(random, 0, 2), whole(random, 0, 2)};
        const Vec3 d{whole(random, -2, 2), whole(random, -2, 2), whole(random, -2, 2)};
        if (d == Vec3{}) continue;
        const double back = whole(random, 0, 5);
        judge_mesh(tally, world, exact, towards(on - back * d, d));
        judge_mesh(tally, world, exact, {on - back * d, d, whole(random, 0, 5), whole(random, 5, 9), 0});
        judge_mesh(tally, world, exact, {on - back * d, d, whole(random, 0, 2), whole(random, 3, 5), 0});
    }
    check(tally, "row");
    CHECK(tally.hits > tally.rays / 4);
}

}  // namespace limn::lattice_test
