// Figures 6 to 9: lone convex bodies under a constant sky, where every pixel is exactly texture times sky.
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "catch.h"
#include "figure_data.h"
#include "scene_parts.h"
#include "support.h"

namespace limn::test_textured {

using namespace test;

namespace {

const Color kSky = figures::kSecondBookSky.top;

// Where the ray enters the sphere of radius r around the centre; textbook quadratic, without the library.
std::optional<Point3> enter_sphere(const Ray& ray, const Point3& center, double r) {
    const Vec3 d = normalize(ray.direction), o = ray.origin - center;
    const double b = dot(o, d), disc = b * b - (dot(o, o) - r * r);
    if (disc < 0) return std::nullopt;
    return ray.origin + (-b - std::sqrt(disc)) * d;
}

// Where it enters the cube [-1, 1]^3.
std::optional<Point3> enter_cube(const Ray& ray) {
    double enter = -kInfinity, leave = kInfinity;
    for (std::size_t a = 0; a < 3; ++a) {
        const double t0 = (-1 - ray.origin[a]) / ray.direction[a], t1 = (1 - ray.origin[a]) / ray.direction[a];
        enter = std::max(enter, std::min(t0, t1)), leave = std::min(leave, std::max(t0, t1));
    }
    if (enter > leave) return std::nullopt;
    return ray.at(enter);
}

Image render_centres(const Figure& figure) {
    RenderSettings settings = figure.settings;
    settings.samples_per_pixel = 1;
    settings.antialias = false;
    return render(compile(figure.scene), figure.camera, settings).image;
}

Marble figure_marble() { return {4, figures::read_perlin_lattice(figures::data_file("perlin_lattice.txt"))}; }

// The places' rounding (1e-14 at most) times the marble's steepest slope (below 1e3).
constexpr double kMarbleRounding = 1e-11;

// Pixels that are not marble times sky where `enter` finds the body, or not sky where it does not.
template <class Enter>
int wrong_marble_pixels(const Figure& figure, const Enter& enter) {
    const Image image = render_centres(figure);
    const Marble marble = figure_marble();
    int wrong = 0;
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 400; ++x) {
            const Color c = image.at(x, y);
            const auto p = enter(picture_ray(figure.camera, 400, x + .5, y + .5));
            const double value = p ? marble.value(surface_at(*p)).b : 1;
            wrong += !close(c.b, value, std::ldexp(1, -24) + kMarbleRounding);
            wrong += !same_float(c.r, .7 * c.b) || !same_float(c.g, .8 * c.b);
        }
    return wrong;
}

// An 8-bit map of all values, in the sRGB transfer; removed at the end.
class MapFile {
public:
    MapFile() : path(std::filesystem::temp_directory_path() / ("limn-map-" + std::to_string(getpid()) + ".png")) {
        Image image(kWidth, kHeight);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const auto decoded = [&](int channel) { return srgb_decode(texel(x, y, channel) / 255.0); };
                image.set(x, y, {decoded(0), decoded(1), decoded(2)});
            }
        save_image(image, path);
    }
    ~MapFile() { std::filesystem::remove(path); }

    static constexpr int kWidth = 256, kHeight = 128;
    static int texel(int x, int y, int channel) { return (x * (channel + 1) + 37 * y) % 256; }
    const std::string path;
};

}  // namespace

TEST_CASE("Figure 6: every pixel is exactly a texel times the sky", "[figures]") {
    const MapFile map;
    const Encoding encoding = GENERATE(Encoding::raw, Encoding::srgb);
    const Figure figure = figures::fig06_earth({.texture = map.path, .texture_encoding = encoding});
    const Image image = render_centres(figure);
    int wrong = 0, on_sphere = 0;
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 400; ++x) {
            const auto p = enter_sphere(picture_ray(figure.camera, 400, x + .5, y + .5), {0, 0, 0}, 2);
            if (!p) {
                wrong += !same_float(image.at(x, y), kSky);
                continue;
            }
            ++on_sphere;
            const double nx = p->x / 2, ny = p->y / 2, nz = p->z / 2;
            const double column = (std::atan2(-nz, nx) + std::numbers::pi) / (2 * std::numbers::pi) * MapFile::kWidth;
            const double row = (1 - std::acos(-ny) / std::numbers::pi) * MapFile::kHeight;
            const auto seen = [&](int channel) {
                const double stored = MapFile::texel(int(column), int(row), channel) / 255.0;
                return encoding == Encoding::raw ? stored : srgb_decode(stored);
            };
            // Textures are float32, too, so that there are two roundings.
            const Color truth = Color{seen(0), seen(1), seen(2)} * kSky, c = image.at(x, y);
            wrong += !close(c.r, truth.r, std::ldexp(1, -23)) || !close(c.g, truth.g, std::ldexp(1, -23)) ||
                     !close(c.b, truth.b, std::ldexp(1, -23));
        }
    CHECK(wrong == 0);
    CHECK(close(on_sphere / 160000.0, .7217, 5e-4));  // centres counted instead of area
}

TEST_CASE("Figure 6: the ball has the radius that projection gives it, and the corners show the sky", "[figures]") {
    const MapFile map;
    const Figure figure = figures::fig06_earth({.texture = map.path});
    const double radius =
        boundary(200, 400,
                 [&](double x) {
                     return figure.scene.objects()[0]->hit(picture_ray(figure.camera, 400, x, 200)).has_value();
                 }) -
        200;
    CHECK(close(radius, 191.72, .005));
    CHECK(close(std::numbers::pi * radius * radius / 160000, .7217, 5e-5));
    const Image image = render_figure(figure, 4);
    for (const int x : {0, 399})
        for (const int y : {0, 399}) CHECK(same_float(image.at(x, y), kSky));
}

TEST_CASE("Figure 6: the Americas face the camera, north up", "[figures]") {
    const Figure figure = figures::fig06_earth();
    const Image image = render_figure(figure, 16);
    // Mean colour of 5 x 5 pixels around a place given in degrees.
    const auto colour = [&](double longitude, double latitude) {
        const double a = radians(longitude), b = radians(latitude);
        const Projected at = project(figure.camera, 400,
                                     {2 * std::cos(a) * std::cos(b), 2 * std::sin(b), -2 * std::sin(a) * std::cos(b)});
        const int x = int(at.x), y = int(at.y);
        const auto mean = [&](std::size_t c) { return mean_over(image, c, x - 2, y - 2, x + 3, y + 3); };
        return Color{mean(0), mean(1), mean(2)};
    };
    CHECK(close(project(figure.camera, 400, {0, 0, 2}).x, 200, 1e-9));  // longitude -90, latitude 0
    const Color pacific = colour(-110, -20), amazon = colour(-62, -5), greenland = colour(-42, 74),
                sahara_of_chile = colour(-69, -22);
    CHECK((pacific.b > pacific.g && pacific.b > pacific.r));
    CHECK(amazon.g > amazon.b);
    CHECK(sahara_of_chile.r > sahara_of_chile.b);
    CHECK(luminance(greenland) > 3 * luminance(pacific));
    CHECK(luminance(greenland) > 3 * luminance(amazon));
}

TEST_CASE("Figure 7: grey marble under one sky keeps the sky's hue at any depth", "[figures]") {
    const Figure figure = figures::fig07_perlin_sphere();
    const Image image = render_figure(figure, 4);
    int wrong = 0;
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 400; ++x) {
            const Color c = image.at(x, y);
            wrong += !same_float(c.r, .7 * c.b) || !same_float(c.g, .8 * c.b) || c.b > 1;
        }
    CHECK(wrong == 0);
}

TEST_CASE("Figure 7: the lone ball is exactly marble times sky, with the histogram of a sine", "[figures]") {
    Figure figure = figures::fig07_perlin_sphere();
    figure.scene = only(figure.scene, {1});
    CHECK(wrong_marble_pixels(figure, [](const Ray& ray) { return enter_sphere(ray, {0, 2, 0}, 2); }) == 0);
    const Image image = render_centres(figure);
    std::array<int, 10> deciles{};
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 400; ++x)
            if (const double b = image.at(x, y).b; b < 1) ++deciles[static_cast<std::size_t>(b * 10)];
    CHECK(deciles[0] + deciles[9] > 2 * (deciles[4] + deciles[5]));
}

TEST_CASE("Figure 8: silhouette, faces and marble of the cube", "[figures]") {
    const Figure figure = figures::fig08_perlin_cube();
    const auto at = [&](double x, double y, double z) { return project(figure.camera, 400, {x, y, z}); };
    CHECK(appears_at(figure.camera, {-1, 1, 1}, 45.1, 108.6));
    CHECK(appears_at(figure.camera, {-1, 1, -1}, 187.9, 55.6));
    CHECK(appears_at(figure.camera, {1, 1, -1}, 350.7, 98.5));
    CHECK(appears_at(figure.camera, {1, -1, -1}, 336.0, 280.3));
    CHECK(appears_at(figure.camera, {1, -1, 1}, 214.5, 373.3));
    CHECK(appears_at(figure.camera, {-1, -1, 1}, 60.6, 293.9));
    const Polygon hexagon{at(-1, 1, 1), at(-1, 1, -1), at(1, 1, -1), at(1, -1, -1), at(1, -1, 1), at(-1, -1, 1)};
    const Polygon x_face{at(1, 1, 1), at(1, 1, -1), at(1, -1, -1), at(1, -1, 1)};
    const Polygon y_face{at(-1, 1, 1), at(-1, 1, -1), at(1, 1, -1), at(1, 1, 1)};
    const Polygon z_face{at(-1, 1, 1), at(1, 1, 1), at(1, -1, 1), at(-1, -1, 1)};
    CHECK(close(share_of_frame(hexagon), .454072, 5e-7));

    const CompiledScene scene = compile(figure.scene);
    int wrong = 0;
    std::array<int, 3> pixels{};
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 400; ++x) {
            const Ray ray = picture_ray(figure.camera, 400, x + .5, y + .5);
            const auto hit = scene.closest_hit(ray);
            wrong += hit.has_value() != contains(hexagon, x + .5, y + .5);
            if (!hit) continue;
            const Normal3 n = scene.surface_at(ray, *hit).normal;
            wrong += contains(x_face, x + .5, y + .5) != (n.x == 1) || contains(y_face, x + .5, y + .5) != (n.y == 1) ||
                     contains(z_face, x + .5, y + .5) != (n.z == 1);
            pixels[0] += n.x == 1, pixels[1] += n.y == 1, pixels[2] += n.z == 1;
        }
    CHECK(wrong == 0);
    CHECK(close(share_of_frame(x_face), .150343, 5e-7));
    CHECK(close(share_of_frame(y_face), .108501, 5e-7));
    CHECK(close(share_of_frame(z_face), .195228, 5e-7));
    for (std::size_t a = 0; a < 3; ++a)
        CHECK(close(pixels[a] / 160000.0, std::array{.150343, .108501, .195228}[a], 1e-3));  // an outline's pixels
    CHECK(wrong_marble_pixels(figure, enter_cube) == 0);
}

TEST_CASE("Figure 8: no light leaks through edges and diagonals, and the marble goes on across them", "[figures]") {
    const Figure figure = figures::fig08_perlin_cube();
    const CompiledScene scene = compile(figure.scene);
    const Marble marble = figure_marble();
    const Point3 eye = figure.camera.look_from;
    // Edges between two visible faces, and both diagonals of each visible face.
    const std::vector<std::pair<Point3, Point3>> seams{
        {{1, 1, 1}, {1, 1, -1}},  {{1, 1, 1}, {1, -1, 1}},  {{1, 1, 1}, {-1, 1, 1}},
        {{1, -1, -1}, {1, 1, 1}}, {{1, 1, -1}, {1, -1, 1}}, {{-1, 1, -1}, {1, 1, 1}},
        {{1, 1, -1}, {-1, 1, 1}}, {{-1, -1, 1}, {1, 1, 1}}, {{-1, 1, 1}, {1, -1, 1}}};
    int leaks = 0, jumps = 0;
    for (const auto& [a, b] : seams)
        for (int i = 1; i < 2000; ++i) {
            const Point3 p = a + (i / 2000.0) * (b - a);
            leaks += !scene.any_hit(Ray{.origin = eye, .direction = p - eye});
            const Vec3 aside = 1e-9 * normalize(cross(p - eye, b - a));
            const auto value = [&](const Vec3& offset) {
                const auto q = enter_cube(Ray{.origin = eye, .direction = p + offset - eye});
                return marble.value(surface_at(*q)).b;
            };
            jumps += !close(value(aside), value(-aside), 1e-5);  // 2e-9 apart, slopes below 1e3
        }
    CHECK(leaks == 0);
    CHECK(jumps == 0);
}

TEST_CASE("Figure 8: a hundred times larger, with camera and texture, it is the same picture", "[figures]") {
    const Figure figure = figures::fig08_perlin_cube();
    const auto& mesh = dynamic_cast<const Mesh&>(*figure.scene.objects().at(0));
    MeshData data = mesh.data();
    for (Float3& v : data.vertices) v = {100 * v.x, 100 * v.y, 100 * v.z};
    const auto lattice = figures::read_perlin_lattice(figures::data_file("perlin_lattice.txt"));
    const auto marble = std::make_shared<Lambertian>(std::make_shared<Marble>(4 / 100.0, lattice));
    Figure large = figure;
    large.scene = scene_of(figure.scene.background, {std::make_shared<Mesh>(data, marble)});
    large.camera.look_from = {500, 400, 600};
    const Image small_image = render_figure(figure, 4), large_image = render_figure(large, 4);
    int wrong = 0;
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 400; ++x) {
            const Color a = small_image.at(x, y), b = large_image.at(x, y);
            wrong += !close(a.b, b.b, std::ldexp(1, -23) + kMarbleRounding) ||
                     !close(a.r, b.r, std::ldexp(1, -23) + kMarbleRounding);
        }
    CHECK(wrong == 0);
}

TEST_CASE("Figure 9: three colours, and as much of the dark as of the light cells", "[figures]") {
    const Figure figure = figures::fig09_checkered_triangle();
    CHECK(appears_at(figure.camera, {-2, -1.5, .1}, 32.27, 325.80));
    CHECK(appears_at(figure.camera, {2, -1.5, .1}, 367.73, 325.80));
    CHECK(appears_at(figure.camera, {0, 2, .1}, 200, 32.27));
    const auto at = [&](double x, double y) { return project(figure.camera, 400, {x, y, .1}); };
    const Polygon triangle{at(-2, -1.5), at(2, -1.5), at(0, 2)};
    CHECK(close(share_of_frame(triangle), .307718, 5e-7));

    const Image image = render_centres(figure);
    const Color even{.14, .24, .10}, odd{.63, .72, .90};
    int wrong = 0, evens = 0, odds = 0;
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 400; ++x) {
            const Color c = image.at(x, y), mirrored = image.at(399 - x, y);
            const bool is_even = same_float(c, even), is_odd = same_float(c, odd);
            evens += is_even, odds += is_odd;
            if (!contains(triangle, x + .5, y + .5))
                wrong += !same_float(c, kSky);
            else
                wrong += !(is_even && same_float(mirrored, odd)) && !(is_odd && same_float(mirrored, even));
        }
    CHECK(wrong == 0);
    CHECK(evens == odds);

    const auto images =
        replicates(compile(figure.scene), figure.camera, {.width = 100, .height = 100, .samples_per_pixel = 4});
    const auto triangle_mean = [&](std::size_t channel, double sky) {
        return measure(images, [&](const Image& i) { return sky + (mean_over(i, channel) - sky) / .307718; });
    };
    CHECK(agrees(triangle_mean(0, .7), .385, 1e-6));
    CHECK(agrees(triangle_mean(1, .8), .48, 1e-6));
    CHECK(agrees(triangle_mean(2, 1), .50, 1e-6));
}

}  // namespace limn::test_textured
