// Lamps and media at the edges of what scenes hold, each once wrong.
#include "catch.h"
#include "limn/scene/shape/constant_medium.h"
#include "limn/scene/shape/instance.h"
#include "limn/scene/texture/checker.h"
#include "limn/scene/texture/solid.h"
#include "support/pictures.h"

namespace limn::odd_lamps_test {

using namespace test;

namespace {

Object floor_of(double half) { return quad({-half, 0, -half}, {0, 0, 2 * half}, {2 * half, 0, 0}, grey(0.5)); }

// Emits to the front only, which a user's texture may decide.
class FrontOnly final : public Texture {
public:
    Color value(const Surface& s) const override { return s.front_face ? Color{3, 3, 3} : Color{}; }
};

}  // namespace

TEST_CASE("Lamps: one that tells its sides apart shines on one side only, as a square of a checker too", "[render]") {
    const auto front_only = std::make_shared<FrontOnly>();
    const auto one_square = std::make_shared<Checker>(100.0, front_only, std::make_shared<SolidColor>(Color{3, 3, 3}));
    const auto lamp_of = [&](const std::shared_ptr<const Texture>& texture, const Vec3& u, const Vec3& v) {
        const CompiledScene scene =
            compile_with(sky(0), {floor_of(5), quad({0.5, 1, 0.5}, u, v, std::make_shared<DiffuseLight>(texture))});
        return measure(scene, camera_at({1, 0.5, 1}, {1, 0, 1}, 10), square(4, 256, 2));
    };
    for (const std::shared_ptr<const Texture>& texture :
         {std::shared_ptr<const Texture>(front_only), std::shared_ptr<const Texture>(one_square)}) {
        CHECK(lamp_of(texture, {0, 0, 1}, {1, 0, 0}).mean == 0);  // faces up
        CHECK(lamp_of(texture, {1, 0, 0}, {0, 0, 1}).mean > 0.1);
    }
}

TEST_CASE("Lamps: close to one that an instance has shrunk or grown, no light is lost", "[render]") {
    // A ceiling so large that the floor point under it sees radiance 1 everywhere: 0.5 comes back.
    for (const double scale : {1e-6, 1e-3, 1.0, 1e3}) {
        const double side = 1e4 / scale;
        const auto ceiling = std::make_shared<Instance>(quad({0, 0, 0}, {side, 0, 0}, {0, 0, side}, lamp(1)),
                                                        Transform::scale(scale, scale, scale));
        const CompiledScene scene =
            compile_with(sky(0), {quad({4e3, -0.1, 4e3}, {0, 0, 2e3}, {2e3, 0, 0}, grey(0.5)), ceiling});
        check_mean(measure(scene, camera_at({5e3, -0.05, 5e3}, {5e3, -0.1, 5e3}, 1), square(2, 16, 2)), 0.5, 1e-2);
    }
}

TEST_CASE("Media: extinction up to the largest finite numbers gives no NaN", "[render]") {
    for (const double density : {1e150, 1e300, 1e308}) {
        const auto smoke = std::make_shared<ConstantMedium>(sphere({0, 1, 0}, 0.5, nullptr), density, Color{});
        const CompiledScene scene =
            compile_with(sky(1), {floor_of(5), smoke, quad({-1, 3, -1}, {2, 0, 0}, {0, 0, 2}, lamp(2))});
        const RenderResult result = render(scene, camera_at({0, 1, 4}, {0, 0.5, 0}, 30), square(16, 16, 5));
        CHECK(result.report.nonfinite_samples == 0);
    }
}

}  // namespace limn::odd_lamps_test
