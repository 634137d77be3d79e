// Rays that extreme numbers make unusable while a picture is rendered: each is counted and carries no light.
#include "support/pictures.h"

namespace limn::unusable_rays_test {

using namespace test;

namespace {

const double kNaN = std::numeric_limits<double>::quiet_NaN();

// Glows, and scatters into one direction that need not be one.
class OneWay final : public Material {
public:
    explicit OneWay(const Vec3& direction) : direction_(direction) {}
    Color emitted(const Surface&) const override { return {0.25, 0.25, 0.25}; }
    std::optional<ScatterSample> sample(const Surface&, const Vec3&, const Random3&) const override {
        return ScatterSample{direction_, {1, 1, 1}, 0};
    }

private:
    Vec3 direction_;
};

// A wall whose points lie nowhere in particular.
class Blurred final : public Hittable {
public:
    Blurred(Object wall, double error) : wall_(std::move(wall)), error_(error) {}
    Box bounds() const override { return wall_->bounds(); }
    std::optional<Hit> hit(const Ray& ray) const override {
        std::optional<Hit> hit = wall_->hit(ray);
        if (hit) hit->position_error = {error_, error_, error_};
        return hit;
    }

private:
    Object wall_;
    double error_;
};

Object wall_of(const MaterialPtr& m) { return quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, m); }

const Camera kEye = camera_at({0, 0, 5}, {0, 0, 0}, 40);
constexpr std::uint64_t kSamples = 8 * 8 * 16;

void check_one_lost_ray_a_sample(const std::vector<Object>& objects, const Background& background, float light) {
    const RenderResult r = render(compile_with(background, objects), kEye, square(8, 16, 10));
    CHECK(r.report.unusable_rays == kSamples);
    CHECK(r.report.rays == 2 * kSamples);
    CHECK(r.report.nonfinite_samples == 0);
    for (const float v : r.image.values()) CHECK(v == light);
}

}  // namespace

TEST_CASE("render: a direction of a user's own material that is none is counted, and carries no light",
          "[render][unusable]") {
    const Object fog = std::make_shared<ConstantMedium>(sphere({50, 0, 0}, 1, nullptr), 1, Color{1, 1, 1});
    for (const Vec3& direction : {Vec3{}, Vec3{-0.0, 0, 0}, Vec3{kNaN, 0, 1}, Vec3{0, kInfinity, 0}}) {
        const Object wall = wall_of(std::make_shared<OneWay>(direction));
        check_one_lost_ray_a_sample({wall}, sky(1), 0.25F);
        check_one_lost_ray_a_sample({wall}, Background::gradient({1, 1, 1}, {0.5, 0.7, 1}), 0.25F);
        check_one_lost_ray_a_sample({wall, fog}, sky(1), 0.25F);
    }
}

TEST_CASE("render: a ray from a point that a user's own shape cannot place is counted, and carries no light",
          "[render][unusable]") {
    for (const double error : {kNaN, kInfinity})
        check_one_lost_ray_a_sample({std::make_shared<Blurred>(wall_of(grey(1)), error)}, sky(1), 0);
}

TEST_CASE("render: shadow rays from such a point are counted too", "[render][unusable]") {
    const Object wall = std::make_shared<Blurred>(wall_of(grey(1)), kNaN);
    const RenderResult r = render(compile_with(sky(1), {wall, sphere({0, 0, 30}, 1, lamp(1))}), kEye, square(8, 16, 2));
    CHECK(r.report.unusable_rays == 2 * kSamples);
    CHECK(r.report.rays == 3 * kSamples);
    CHECK(r.report.nonfinite_samples == 0);
    for (const float v : r.image.values()) CHECK(v == 0);
}

}  // namespace limn::unusable_rays_test
