// What `limn trace` answers.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "catch.h"
#include "limn/io/obj.h"
#include "process.h"
#include "ray_forms.h"
#include "support/folder.h"
#include "support/random_geometry.h"

namespace limn::test::trace_answers_test {
namespace {

// A hilly field of triangles, quads and pentagons, none of them flat, with faces between them that get dropped.
std::string field_obj() {
    constexpr int kSide = 15;  // points; cells come in pairs
    Random random(1);
    std::string obj;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) obj += fmt::format("v {} {:.9g} {}\n", x, random.uniform(0, 2), y);
    for (int y = 0; y + 1 < kSide; ++y) {
        for (int x = 0; x + 2 < kSide; x += 2) {
            const int a = 1 + x + y * kSide, b = a + 1, c = a + 2, d = a + kSide, e = d + 1, f = d + 2;
            switch (random.index(4)) {
                case 0: obj += fmt::format("f {} {} {} {} {}\nf {} {} {}\n", a, b, c, e, d, c, f, e); break;
                case 1: obj += fmt::format("f {} {} {} {}\nf {} {} {} {}\n", a, b, e, d, b, c, f, e); break;
                case 2: obj += fmt::format("f {0} {0} {1}\nf {0} {2} {3}\nf {0} {3} {1}\n", a, d, b, e); break;
                default: obj += fmt::format("f {} {} {}\nf {} {}\nf {} {} {}\n", b, c, f, a, d, b, f, e); break;
            }
        }
    }
    return obj;
}

Targets targets_of(const Mesh& mesh) {
    Targets targets{mesh.bounds(), {}};
    const auto point = [&mesh](std::uint32_t i) {
        const Float3& p = mesh.data().vertices[i];
        return Point3{p.x, p.y, p.z};
    };
    for (const Index3& t : mesh.data().triangles) {
        targets.points.push_back(point(t.a));
        targets.points.push_back(point(t.a) + 0.5 * (point(t.b) - point(t.a)));
    }
    return targets;
}

// As `limn trace --binary` writes it.
std::vector<double> brute_force(const Mesh& mesh, const std::vector<Ray>& rays) {
    std::vector<double> answers;
    for (const Ray& ray : rays) {
        const auto hit = mesh.hit(ray);
        if (hit)
            answers.insert(answers.end(), {hit->t, static_cast<double>(mesh.face(hit->element)), hit->u, hit->v});
        else
            answers.insert(answers.end(), {kInfinity, -1, 0, 0});
    }
    return answers;
}

std::vector<double> from_text(const std::string& text) {
    std::vector<double> answers;
    for (const std::string& line : lines(text)) {
        if (line == "miss") {
            answers.insert(answers.end(), {kInfinity, -1, 0, 0});
            continue;
        }
        const char* rest = line.c_str();
        for (char* end = nullptr; *rest != '\0'; rest = end) {
            answers.push_back(std::strtod(rest, &end));
            if (end == rest) FAIL("not a number: " << line);
        }
    }
    return answers;
}

TEST_CASE("limn trace: answers are those of every triangle tried in turn, bit for bit, in every form", "[cli][trace]") {
    const Folder folder;
    const std::string model = folder.write("field.obj", field_obj());
    const auto mesh = load_obj(model).meshes.at(0);
    Random random(2);
    std::vector<Ray> rays;
    std::string text, binary;
    for (int i = 0; i < 10'000; ++i) {
        rays.push_back(random_ray(random, targets_of(*mesh)));
        rays.back().time = 0;
        text += to_text(rays.back());
        binary += to_binary(numbers_of(rays.back()));
    }
    REQUIRE(text.size() > std::size_t{1} << 20);  // more than is read at once
    const std::vector<double> truth = brute_force(*mesh, rays);
    std::string any_text;
    std::vector<double> any_truth;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        any_truth.push_back(truth[4 * i] < kInfinity ? 1 : 0);
        any_text += any_truth.back() == 1 ? "1\n" : "0\n";
    }
    REQUIRE(std::count(any_truth.begin(), any_truth.end(), 1.0) > 3000);

    const std::string text_file = folder.write("rays.txt", text), binary_file = folder.write("rays.bin", binary);
    const Outcome as_text = limn_reads("", {"trace", model, "--rays", text_file});
    CHECK(as_text.status == 0);
    CHECK(as_text.err.empty());
    CHECK(to_binary(from_text(as_text.out)) == to_binary(truth));
    CHECK(limn_reads("", {"trace", model, "--rays", binary_file, "--binary"}).out == to_binary(truth));
    CHECK(limn_reads("", {"trace", model, "--rays", text_file, "--any"}).out == any_text);
    CHECK(limn_reads("", {"trace", model, "--rays", binary_file, "--any", "--binary"}).out == to_binary(any_truth));
}

TEST_CASE("limn trace: u and v weigh the second and third corner, t counts directions", "[cli][trace]") {
    const Folder folder;
    const std::string model = folder.write("a.obj", kTriangleObj);
    const auto answer = [&model](const std::string& ray) { return limn_reads(ray + "\n", {"trace", model}).out; };
    CHECK(answer(kTriangleRay) == std::string(kTriangleAnswer) + "\n");
    CHECK(answer("1 2 -1 0 0 0.125") == "8 0 0.25 0.5\n");  // from behind
    CHECK(answer("1 2 3 0 0 -3e20") == "9.9999999999999995e-21 0 0.25 0.5\n");
    CHECK(answer("2 1 -1 0 0 -1") == "miss\n");
    CHECK(answer("2 1 -1 0 0 -1 -5 0") == "-1 0 0.5 0.25\n");  // t may be negative
    CHECK(answer("3 2 1 0 0 -1") == "miss\n");                 // beside it
}

TEST_CASE("limn trace: faces count as in the file, those that are dropped too, polygons whole", "[cli][trace]") {
    const Folder folder;
    const std::string model = folder.write("a.obj",
                                           "v 0 0 0\nv 4 0 0\nv 0 4 0\n"
                                           "v 10 0 0\nv 12 0 0\nv 12 2 0\nv 10 2 0\n"
                                           "v 20 0 0\nv 22 0 0\nv 23 2 0\nv 21 3 0\nv 19 2 0\n"
                                           "f 1 1 2\n"         // 0: no area
                                           "f 1 2 3\n"         // 1
                                           "f 1 2\n"           // 2: two corners
                                           "f 4 5 6 7\n"       // 3
                                           "f 1 2 2 1\n"       // 4: no area
                                           "f 8 9 10 11 12\n"  // 5
                                           "f 4 5 6\n");       // 6: on a part of 3
    const auto face_at = [&model](double x, double y) {
        const Outcome outcome = limn_reads(fmt::format("{} {} 1 0 0 -1\n", x, y), {"trace", model});
        return from_text(outcome.out).at(1);
    };
    CHECK(face_at(1, 1) == 1);
    CHECK(face_at(11.75, 0.5) == 3);
    CHECK(face_at(10.25, 1.5) == 3);
    for (const auto& [x, y] : {std::pair{19.5, 1.75}, {21, 0.5}, {21, 2.75}, {22.5, 1.75}, {21, 1.5}})
        CHECK(face_at(x, y) == 5);
    CHECK(face_at(5, 5) == -1);
}

TEST_CASE("limn trace: of faces that are hit at the same distance the lowest is named", "[cli][trace]") {
    const std::string vertices = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n";
    const std::string low = "f 1 2 3\n", high = "f 3 4 1\n", far = "f 2 3 4\n";
    // At the middle of the edge that low and high share, and at a corner of all three.
    const std::string rays = "1 1 1 0 0 -1\n2 2 1 0 0 -1\n";
    for (const std::string& faces : {low + high + far, high + low + far, high + high + low, low + far + high}) {
        const Folder folder;
        const Outcome outcome = limn_reads(rays, {"trace", folder.write("a.obj", vertices + faces)});
        const std::vector<double> answers = from_text(outcome.out);
        CAPTURE(faces, outcome.out);
        REQUIRE(answers.size() == 8);
        CHECK(answers[1] == 0);
        CHECK(answers[5] == 0);
    }
}

TEST_CASE("limn trace: the interval is open at tmin and closed at tmax", "[cli][trace]") {
    const Folder folder;
    const std::string model = folder.write("a.obj", kTriangleObj);
    const auto is_hit = [&model](const std::string& interval) {
        const std::string ray = std::string(kTriangleRay) + " " + interval + "\n";  // hits at 1.5
        const std::string closest = limn_reads(ray, {"trace", model}).out;
        const bool hit = closest == std::string(kTriangleAnswer) + "\n";
        CHECK(hit != (closest == "miss\n"));
        CHECK(limn_reads(ray, {"trace", model, "--any"}).out == (hit ? "1\n" : "0\n"));
        return hit;
    };
    CHECK(is_hit("0 inf"));
    CHECK(is_hit("-inf inf"));
    CHECK(is_hit("0 1.5"));
    CHECK_FALSE(is_hit("0 1.4999999999999998"));
    CHECK_FALSE(is_hit("1.5 inf"));
    CHECK(is_hit("1.4999999999999998 inf"));
    CHECK_FALSE(is_hit("1.5 1.5"));
}

TEST_CASE("limn trace: rays that cannot be used are misses, and counted", "[cli][trace]") {
    const Folder folder;
    const std::string model = folder.write("a.obj", kTriangleObj);
    std::string text = std::string(kTriangleRay) + "\n", binary = to_binary({1, 2, 3, 0, 0, -2, 0, kInfinity});
    std::size_t count = 0;
    for (const Ray& ray : unusable_rays()) {
        if (!std::isfinite(ray.time)) continue;  // the forms have no time
        text += to_text(ray);
        binary += to_binary(numbers_of(ray));
        ++count;
    }
    REQUIRE(count > 20);
    const std::string counted = fmt::format("counted as misses: {}\n", count);

    const Outcome outcome = limn_reads(text, {"trace", model});
    CHECK(outcome.status == 0);
    CHECK(outcome.err.ends_with(counted));
    CHECK(lines(outcome.out).size() == count + 1);
    CHECK(lines(outcome.out).front() == kTriangleAnswer);
    CHECK(std::count(outcome.out.begin(), outcome.out.end(), 'm') == static_cast<std::ptrdiff_t>(count));

    const Outcome any = limn_reads(binary, {"trace", model, "--binary", "--any"});
    CHECK(any.err.ends_with(counted));
    std::vector<double> expected(count + 1, 0);
    expected.front() = 1;
    CHECK(from_binary(any.out) == expected);
    CHECK(limn_reads(text, {"trace", model, "--quiet"}).err.empty());
}

}  // namespace
}  // namespace limn::test::trace_answers_test
