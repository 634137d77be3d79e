// Figures 10, 11 and 12: mirrors, brushed metal, emitters.
#include <cmath>

#include "catch.h"
#include "figure_data.h"
#include "scene_parts.h"
#include "support.h"

namespace limn::test_metal_and_light {

using namespace test;

namespace {

const Color kMirroredSky{.49, .48, .5};

// The variance of the noise-free pixels of a region: the covariance of two independent renders.
double covariance(const Image& a, const Image& b, int x0, int y0, int x1, int y1) {
    const double mean_a = mean_over(a, 0, x0, y0, x1, y1), mean_b = mean_over(b, 0, x0, y0, x1, y1);
    double sum = 0;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) sum += (a.at(x, y).r - mean_a) * (b.at(x, y).r - mean_b);
    return sum / ((x1 - x0) * (y1 - y0));
}

}  // namespace

TEST_CASE("Figure 10: the horizon and the ball's outline are where projection puts them, and the ball mirrors the sky",
          "[figures]") {
    const Figure figure = figures::fig10_specular();
    CHECK(close(horizon(figure, 200), 129.56, .005));
    CHECK(close(horizon(figure, 0), 130.68, .005));
    CHECK(close(horizon(figure, 400), 130.68, .005));
    const double edge = boundary(200, 400, [&](double x) {
        return figure.scene.objects()[1]->hit(picture_ray(figure.camera, 400, x, 200)).has_value();
    });
    CHECK(close(edge - 200, 133.7, .05));
    const Image image = render_figure(figure, 4), other = render_figure(figure, 4, 2);
    int wrong = 0;
    for (int y = 190; y < 210; ++y)
        for (int x = 190; x < 210; ++x)
            wrong += !same_float(image.at(x, y), kMirroredSky) || image.at(x, y) != other.at(x, y);
    CHECK(wrong == 0);
    CHECK(image != other);  // the noise on the ground
}

TEST_CASE("Figure 11: fuzz blurs the mirrored checker, and leaves what mirrors the sky exact", "[figures]") {
    const Figure mirror = figures::fig10_specular(), brushed = figures::fig11_metal();
    const auto render_all = [](const Figure& figure) {
        return replicates(compile(figure.scene), figure.camera, {.samples_per_pixel = 4}, 16);
    };
    const std::vector<Image> sharp = render_all(mirror), blurred = render_all(brushed);

    int wrong = 0;
    for (int y = 90; y <= 140; ++y)
        for (int x = 190; x < 210; ++x) wrong += !same_float(blurred[0].at(x, y), kMirroredSky);
    CHECK(wrong == 0);

    const auto mean = [](const std::vector<Image>& images) {
        return measure(images, [](const Image& image) { return mean_over(image, 0, 160, 230, 240, 290); });
    };
    const auto variance = [](const std::vector<Image>& images) {
        std::vector<double> values;  // of disjoint pairs
        for (std::size_t i = 0; i + 1 < images.size(); i += 2)
            values.push_back(covariance(images[i], images[i + 1], 160, 230, 240, 290));
        return estimate(values);
    };
    CAPTURE(mean(sharp).mean, mean(sharp).error, mean(blurred).mean, mean(blurred).error);
    CHECK(agrees(mean(sharp), .2576, 5e-5));
    CHECK(agrees(mean(blurred), .2535, 5e-5));
    CAPTURE(variance(sharp).mean, variance(sharp).error, variance(blurred).mean, variance(blurred).error);
    CHECK(agrees(variance(sharp), .146 * .146, 2 * .146 * .0005));
    CHECK(agrees(variance(blurred), .028 * .028, 2 * .028 * .0005));

    // Grazing absorption costs the frame 0.3 %.
    std::vector<double> changes;
    for (std::size_t i = 0; i < sharp.size(); ++i)
        changes.push_back(mean_over(blurred[i], 0) / mean_over(sharp[i], 0) - 1);
    const Estimate change = estimate(changes);
    CAPTURE(change.mean, change.error);
    CHECK(agrees(change, -.003, 5e-4));
    CHECK(change.mean < 0);
}

TEST_CASE("Figure 12: emitters are exactly 4, the sky exactly black, everything grey", "[figures]") {
    const Figure figure = figures::fig12_emissive();
    CHECK(close(horizon(figure, 200), 220.13, .005));
    CHECK(close(horizon(figure, 0), 221.56, .005));
    CHECK(close(horizon(figure, 400), 221.56, .005));
    const Image image = render_figure(figure, 4);
    int wrong = 0, lamp = 0, sky = 0;
    for_each_pixel(figure, [&](int x, int y, const Footprint& footprint) {
        const Color c = image.at(x, y);
        wrong += c.r != c.g || c.g != c.b;
        if (all_see(footprint, 2) || all_see(footprint, 3)) {
            ++lamp;
            wrong += c != Color{4, 4, 4};
        } else if (all_see_sky(footprint)) {
            ++sky;
            wrong += c != Color{};
        }
        if (y >= 80 && y <= 100) wrong += c != Color{};  // between lamp and ball
    });
    CHECK(wrong == 0);
    CHECK((lamp > 5000 && sky > 20000));
}

TEST_CASE("Figure 12: by scattering alone nothing can be brighter than its brightest lamp", "[figures]") {
    Figure figure = figures::fig12_emissive();
    figure.settings.estimator = Estimator::naive;
    const Image image = render_figure(figure, 4);
    float brightest = 0;
    for (const float value : image.values()) brightest = std::max(brightest, value);
    CHECK(brightest == 4);
}

TEST_CASE("Figure 12: the ball casts a soft shadow below itself", "[figures]") {
    // Grey instead of marble, so that places can be compared; the ground alone has no shadow.
    const Figure figure = figures::fig12_emissive();
    const auto grey = figures::matte({.5, .5, .5});
    const auto ground = std::make_shared<Sphere>(Point3{0, -1000, 0}, 1000.0, grey);
    const auto ball = std::make_shared<Sphere>(Point3{0, 2, 0}, 2.0, grey);
    const auto lamp = figure.scene.objects()[2];
    const CompiledScene open = compile(scene_of(Background::black(), {ground, lamp}));
    const CompiledScene shaded = compile(scene_of(Background::black(), {ground, ball, lamp}));
    // Direct light only. Ball and lamp have equal radii, so that their outer tangents are upright and the umbra ends
    // where |z| = 2; the inner tangents cross half-way, at height 4.5 with slope 3/4, and the penumbra ends at |z| = 6.
    const auto share_lit = [&](double z) {
        const auto seen = [&](const CompiledScene& scene) {
            const Point3 at{0, std::sqrt(1e6 - z * z) - 1000, z};
            return radiance(scene, at + Vec3{.3, .1, .3}, at, {.samples_per_pixel = 1000, .max_depth = 2}).g;
        };
        const Estimate with = seen(shaded), without = seen(open);
        return Estimate{with.mean / without.mean, std::hypot(with.error, without.error) / without.mean};
    };
    CHECK(share_lit(1.5).mean == 0);
    CHECK(share_lit(1.9).mean == 0);
    double before = 0;
    for (const double z : {2.5, 3.25, 4.0, 4.75, 5.5}) {
        const Estimate share = share_lit(z);
        CAPTURE(z, share.mean, share.error, before);
        CHECK(share.mean > before + kSigmas * share.error);
        before = share.mean;
    }
    CHECK(before < 1);
    CHECK(agrees(share_lit(6.2), 1));
}

}  // namespace limn::test_metal_and_light
