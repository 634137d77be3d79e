// What is in each figure, number by number, as the report and the books that it follows have it.
#include <fmt/format.h>

#include "catch.h"
#include "figure_data.h"
#include "limn/records/record_sink.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/metal.h"
#include "support.h"

namespace limn::test_contents {

namespace {

std::string text(const Point3& p) { return fmt::format("({:g}, {:g}, {:g})", p.x, p.y, p.z); }
std::string text(const Vec3& v) { return fmt::format("({:g}, {:g}, {:g})", v.x, v.y, v.z); }
std::string text(const Color& c) { return fmt::format("({:g}, {:g}, {:g})", c.r, c.g, c.b); }

// Writes the records of a scene as one line for each object.
class Writer {
public:
    explicit Writer(const Scene& scene) {
        for (const auto& object : scene.objects()) object->lower(sink_);
        for (const PrimitiveRange& range : r_.blases[0].ranges)
            for (std::uint64_t i = 0; i < (range.kind == PrimitiveKind::mesh || is_blas(range) ? 1 : range.count); ++i)
                lines += line(range.kind, range.first_row + i) + "\n";
    }
    std::string lines;

private:
    static bool is_blas(const PrimitiveRange& range) {
        return range.kind == PrimitiveKind::instance || range.kind == PrimitiveKind::medium;
    }

    std::string line(PrimitiveKind kind, std::size_t row) const {
        switch (kind) {
            case PrimitiveKind::sphere:
            case PrimitiveKind::moving_sphere: {
                const SphereRecord& s = r_.spheres[row];
                const std::string way = s.center0 == s.center1 ? "" : " to " + text(s.center1);
                return fmt::format("sphere {}{} {:g}: {}", text(s.center0), way, s.radius, material(s.material));
            }
            case PrimitiveKind::triangle: {
                const TriangleRecord& t = r_.triangles[row];
                return fmt::format("triangle {} {} {}: {}", text(t.a), text(t.b), text(t.c), material(t.material));
            }
            case PrimitiveKind::quad: {
                const QuadRecord& q = r_.quads[row];
                return fmt::format("quad {} {} {}: {}", text(q.corner), text(q.edge_u), text(q.edge_v),
                                   material(q.material));
            }
            case PrimitiveKind::mesh:
                return fmt::format("mesh of {}: {}", r_.meshes[row].arrays.triangles.size(),
                                   material(r_.meshes[row].materials.at(0)));
            case PrimitiveKind::instance: {
                const InstanceRecord& i = r_.instances[row];
                const auto& m = i.world_from_object0.rows;
                return fmt::format("x ({:g}, {:g}, {:g}), z ({:g}, {:g}, {:g}), origin ({:g}, {:g}, {:g}){}: {}",
                                   m[0][0], m[1][0], m[2][0], m[0][2], m[1][2], m[2][2], m[0][3], m[1][3], m[2][3],
                                   i.moving ? " moving" : "", blas(i.blas));
            }
            case PrimitiveKind::medium: {
                const MediumRecord& m = r_.media[row];
                return fmt::format("{} of density {:g} in {}", material(m.phase), m.density, blas(m.boundary));
            }
            default: break;
        }
        return "something else";
    }

    // A BLAS of quads by its corners, another by its only member.
    std::string blas(BlasId id) const {
        const PrimitiveRange& range = r_.blases[static_cast<std::size_t>(id)].ranges.at(0);
        if (range.kind != PrimitiveKind::quad) return line(range.kind, range.first_row);
        Box box;
        for (std::size_t i = 0; i < range.count; ++i) {
            const QuadRecord& q = r_.quads[range.first_row + i];
            box.extend(q.corner);
            box.extend(q.corner + q.edge_u + q.edge_v);
        }
        return fmt::format("{} quads {} {}: {}", range.count, text(box.lower), text(box.upper),
                           material(r_.quads[range.first_row].material));
    }

    std::string material(MaterialId id) const {
        const MaterialRecord& m = r_.materials[static_cast<std::size_t>(id)];
        if (m.kind == "lambertian") return texture(m.albedo);
        if (m.kind == "metal")
            return fmt::format("metal {} {:g}", texture(m.albedo), m.parameters.as<Metal::Parameters>().fuzz);
        if (m.kind == "dielectric") {
            const auto glass = m.parameters.as<Dielectric::Parameters>();
            return fmt::format("glass {:g}{}", glass.index, glass.exact_fresnel == 1 ? "" : " by Schlick");
        }
        if (m.kind == "diffuse-light") return "lamp " + texture(m.emission);
        if (m.kind == "isotropic") return "smoke " + texture(m.albedo);
        return "something else";
    }

    std::string texture(TextureId id) const {
        const TextureRecord& t = r_.textures[static_cast<std::size_t>(id)];
        switch (t.kind) {
            case TextureKind::solid: return text(t.color);
            case TextureKind::checker:
                return fmt::format("checker {:g} {} {}", t.scale, texture(t.even), texture(t.odd));
            case TextureKind::marble: {
                const auto lattice = figures::read_perlin_lattice(figures::data_file("perlin_lattice.txt"));
                return fmt::format("marble {:g} {}{}", t.scale, text(t.color),
                                   *r_.lattices[t.data] == *lattice ? "" : " of another lattice");
            }
            case TextureKind::image:  // whichever: of figure 6 the installed package decides
                return fmt::format("image{}{}", t.filter == Filter::nearest ? " nearest" : "",
                                   t.wrap == Wrap::clamp ? " clamp" : "");
            case TextureKind::noise:
            case TextureKind::turbulence:
            case TextureKind::user_defined: break;
        }
        return "something else";
    }

    RecordSink sink_;
    const SceneRecords& r_ = sink_.records();
};

std::string sky_of(const Background& b) { return text(b.bottom) + (b.bottom == b.top ? "" : " to " + text(b.top)); }

std::string view_of(const Camera& c) {
    std::string view = fmt::format("{} to {} {:g}", text(c.look_from), text(c.look_at), c.vertical_fov);
    if (c.aperture_angle != 0) view += fmt::format(" lens {:g} {:g}", c.aperture_angle, c.focus_distance.value());
    const bool usual = c.up == Vec3{0, 1, 0} && !c.aspect_ratio && c.shutter_open == 0 && c.shutter_close == 1;
    return view + (usual ? "" : " and something else");
}

// All but the picture's size, depth, seed, filter and estimator, which are the same everywhere.
std::string settings_of(const RenderSettings& s) {
    const bool usual = s.width == 400 && s.height == 400 && s.max_depth == 10 && s.seed == 0 && s.threads == 0 &&
                       s.estimator == Estimator::path;
    return fmt::format("{} samples{}{}", s.samples_per_pixel, s.antialias ? "" : " in the middle",
                       usual ? "" : " and something else");
}

void check(const Figure& figure, const std::string& name, const std::string& sky, const std::string& view,
           const std::string& settings, const std::string& objects) {
    INFO(name);
    CHECK(figure.name == name);
    CHECK(sky_of(figure.scene.background) == sky);
    CHECK(view_of(figure.camera) == view);
    CHECK(settings_of(figure.settings) == settings);
    CHECK(Writer(figure.scene).lines == objects);
}

const std::string kBlueSky = "(0.7, 0.8, 1)", kPaleSky = "(1, 1, 1) to (0.5, 0.7, 1)", kBlack = "(0, 0, 0)";
const std::string kCheckeredGround = "sphere (0, -1000, 0) 1000: checker 0.32 (0.2, 0.3, 0.1) (0.9, 0.9, 0.9)\n";

}  // namespace

TEST_CASE("Contents: figures 1 and 2 are the checkered ground and the balls of the file", "[figures][contents]") {
    std::string balls = kCheckeredGround;
    for (const auto& s : figures::read_bouncing_spheres(figures::data_file("bounce_spheres.csv"))) {
        balls += "sphere " + text(s.center0) + (s.center0 == s.center1 ? "" : " to " + text(s.center1));
        balls += fmt::format(" {:g}: ", s.radius);
        if (s.material == "metal")
            balls += fmt::format("metal {} {:g}\n", text(s.color), s.parameter);
        else
            balls += (s.material == "dielectric" ? "glass 1.5 by Schlick" : text(s.color)) + "\n";
    }
    for (const char* big : {"sphere (0, 1, 0) 1: glass 1.5 by Schlick\n", "sphere (-4, 1, 0) 1: (0.4, 0.2, 0.1)\n",
                            "sphere (4, 1, 0) 1: metal (0.7, 0.6, 0.5) 0\n"})
        CHECK(balls.find(big) != std::string::npos);
    check(figures::fig01_bouncing_spheres(), "fig01_bouncing_spheres", kBlueSky,
          "(13, 2, 3) to (0, 0, 0) 20 lens 0.6 10", "250 samples", balls);
    check(figures::fig02_from_above(), "fig02_from_above", kBlueSky, "(-6, 10, 3) to (0, 0, 0) 40", "250 samples",
          balls);
}

TEST_CASE("Contents: figures 3, 4, 10 and 11 are a metal ball on the checkered ground", "[figures][contents]") {
    const std::string view = "(6, 2, 6) to (0, 1, 0) 20";
    const std::string mirror = kCheckeredGround + "sphere (0, 1, 0) 1: metal (0.7, 0.6, 0.5) 0\n";
    check(figures::fig03_before_antialiasing(), "fig03_before_antialiasing", kBlueSky, view, "1 samples in the middle",
          mirror);
    check(figures::fig04_after_antialiasing(), "fig04_after_antialiasing", kBlueSky, view, "100 samples", mirror);
    check(figures::fig10_specular(), "fig10_specular", kBlueSky, view, "300 samples", mirror);
    check(figures::fig11_metal(), "fig11_metal", kBlueSky, view, "300 samples",
          kCheckeredGround + "sphere (0, 1, 0) 1: metal (0.7, 0.6, 0.5) 0.3\n");
}

TEST_CASE("Contents: figures 5 to 9 are plain bodies under the blue sky", "[figures][contents]") {
    check(figures::fig05_purple_sphere(), "fig05_purple_sphere", kBlueSky, "(0, 0, 0) to (0, 0, -1) 90", "200 samples",
          "sphere (0, 0, -1) 0.5: (0.5, 0, 0.5)\nsphere (0, -100.5, -1) 100: (0.5, 0.5, 0.5)\n");
    check(figures::fig06_earth(), "fig06_earth", kBlueSky, "(0, 0, 12) to (0, 0, 0) 20", "100 samples",
          "sphere (0, 0, 0) 2: image nearest clamp\n");
    check(figures::fig07_perlin_sphere(), "fig07_perlin_sphere", kBlueSky, "(13, 2, 3) to (0, 0, 0) 20", "200 samples",
          "sphere (0, -1000, 0) 1000: marble 4 (1, 1, 1)\nsphere (0, 2, 0) 2: marble 4 (1, 1, 1)\n");
    check(figures::fig08_perlin_cube(), "fig08_perlin_cube", kBlueSky, "(5, 4, 6) to (0, 0, 0) 25", "100 samples",
          "mesh of 12: marble 4 (1, 1, 1)\n");
    check(figures::fig09_checkered_triangle(), "fig09_checkered_triangle", kBlueSky, "(0, 0, 9) to (0, 0, 0) 30",
          "100 samples",
          "triangle (-2, -1.5, 0.1) (2, -1.5, 0.1) (0, 2, 0.1): checker 0.5 (0.2, 0.3, 0.1) (0.9, 0.9, 0.9)\n");
}

TEST_CASE("Contents: figure 12 is marble under a ball and a pane of light", "[figures][contents]") {
    check(figures::fig12_emissive(), "fig12_emissive", kBlack, "(26, 3, 6) to (0, 2, 0) 20", "300 samples",
          "sphere (0, -1000, 0) 1000: marble 4 (1, 1, 1)\n"
          "sphere (0, 2, 0) 2: marble 4 (1, 1, 1)\n"
          "sphere (0, 7, 0) 2: lamp (4, 4, 4)\n"
          "quad (3, 1, -2) (2, 0, 0) (0, 2, 0): lamp (4, 4, 4)\n");
}

TEST_CASE("Contents: figures 13, 17 and 18 are three balls, by three lenses", "[figures][contents]") {
    const std::string balls =
        "sphere (0, -100.5, -1) 100: (0.8, 0.8, 0)\n"
        "sphere (0, 0, -1) 0.5: (0.1, 0.2, 0.5)\n"
        "sphere (-1, 0, -1) 0.5: glass 1.5 by Schlick\n"
        "sphere (-1, 0, -1) -0.4: glass 1.5 by Schlick\n"
        "sphere (1, 0, -1) 0.5: metal (0.8, 0.6, 0.2) 0.3\n";
    const std::string view = "(-2, 2, 1) to (0, 0, -1) 35";
    check(figures::fig13_dielectric(), "fig13_dielectric", kPaleSky, view, "400 samples", balls);
    check(figures::fig17_without_dof(), "fig17_without_dof", kPaleSky, view, "400 samples", balls);
    check(figures::fig18_with_dof(), "fig18_with_dof", kPaleSky, view + " lens 10 3.4", "400 samples", balls);
}

TEST_CASE("Contents: figure 14 is a ball that rises between two that stay", "[figures][contents]") {
    check(figures::fig14_bouncing_ball(), "fig14_bouncing_ball", kBlueSky, "(0, 0.5, 10) to (0, 0.5, 0) 20",
          "300 samples",
          "sphere (0, -1000.4, 0) 1000: checker 0.32 (0.2, 0.3, 0.1) (0.9, 0.9, 0.9)\n"
          "sphere (0, 0, 0) to (0, 1, 0) 0.4: (0.7, 0.2, 0.1)\n"
          "sphere (-1.1, 0, 0) 0.4: (0.1, 0.2, 0.5)\n"
          "sphere (1.1, 0, 0) 0.4: metal (0.7, 0.6, 0.5) 0\n");
}

TEST_CASE("Contents: figures 15 and 16 are the Cornell box, with boxes and with smoke", "[figures][contents]") {
    const std::string walls =
        "quad (555, 0, 0) (0, 555, 0) (0, 0, 555): (0.12, 0.45, 0.15)\n"
        "quad (0, 0, 0) (0, 555, 0) (0, 0, 555): (0.65, 0.05, 0.05)\n"
        "quad (0, 0, 0) (555, 0, 0) (0, 0, 555): (0.73, 0.73, 0.73)\n"
        "quad (0, 555, 0) (555, 0, 0) (0, 0, 555): (0.73, 0.73, 0.73)\n"
        "quad (0, 0, 555) (555, 0, 0) (0, 555, 0): (0.73, 0.73, 0.73)\n";
    // Turned by 15 and -18 degrees: z goes to (sin, 0, cos).
    const std::string tall =
        "x (0.965926, 0, -0.258819), z (0.258819, 0, 0.965926), origin (265, 0, 295): "
        "6 quads (0, 0, 0) (165, 330, 165): (0.73, 0.73, 0.73)\n";
    const std::string low =
        "x (0.951057, 0, 0.309017), z (-0.309017, 0, 0.951057), origin (130, 0, 65): "
        "6 quads (0, 0, 0) (165, 165, 165): (0.73, 0.73, 0.73)\n";
    const std::string view = "(278, 278, -800) to (278, 278, 0) 40";
    check(figures::fig15_cornell_box(), "fig15_cornell_box", kBlack, view, "100 samples",
          walls + "quad (343, 554, 332) (-130, 0, 0) (0, 0, -105): lamp (15, 15, 15)\n" + tall + low);
    check(figures::fig16_volume_cornell_box(), "fig16_volume_cornell_box", kBlack, view, "100 samples",
          walls + "quad (113, 554, 127) (330, 0, 0) (0, 0, 305): lamp (7, 7, 7)\n" +
              "smoke (0, 0, 0) of density 0.01 in " + tall + "smoke (1, 1, 1) of density 0.01 in " + low);
}

}  // namespace limn::test_contents
