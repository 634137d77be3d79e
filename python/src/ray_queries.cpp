// What rays meet.
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "limn/query/normals.h"
#include "parallel.h"
#include "queries.h"

namespace limn::python {

namespace {

constexpr const char* kRays = "an array of rays, shape (..., 6)";

// Rays as they were given, and their ends.
class RayRows {
public:
    Rows rows;
    std::optional<Rows> directions;  // where `rows` are origins alone
    double t_min = 0, t_max = kInfinity;

    // Origins and directions.
    RayRows(ArrayArgument origins, ArrayArgument ways)
        : rows(origins, "ray_origins", 3, "an array, shape (n, 3)"),
          directions(std::in_place, ways, "ray_directions", 3, "an array, shape (n, 3)") {
        if (directions->shape() != rows.shape()) wrong_value("ray_directions", "must have the shape of ray_origins");
    }

    RayRows(ArrayArgument rays, NumberArgument lowest, NumberArgument highest, const char* lowest_name,
            const char* highest_name)
        : rows(rays, "rays", 6, kRays), t_min(number(lowest, lowest_name)), t_max(number(highest, highest_name)) {
        if (!(t_min < kInfinity)) wrong_value(lowest_name, "must be a number below infinity");
        if (!(t_max >= t_min)) wrong_value(highest_name, "must be a number, not below " + std::string(lowest_name));
    }

    // work(first, rays, of a thread) for all parts, on `threads` of them.
    template <class Work>
    void for_all(int threads, const Work& work) const {
        rows.visit([&](const auto* numbers) {
            if (!directions) return for_all(threads, numbers, numbers + 3, 6, work);
            directions->visit([&](const auto* ways) { for_all(threads, numbers, ways, 3, work); });
        });
    }

private:
    // `stride` numbers from one origin and one direction to the next.
    template <class T, class U, class Work>
    void for_all(int threads, const T* origins, const U* ways, std::size_t stride, const Work& work) const {
        for_all_rows(rows.count(), threads, [&](std::size_t first, std::size_t count) {
            thread_local std::vector<Ray> rays;
            rays.resize(count);
            for (std::size_t i = 0; i < count; ++i) {
                const T* const o = origins + stride * (first + i);
                const U* const d = ways + stride * (first + i);
                rays[i] = {
                    .origin = {o[0], o[1], o[2]}, .direction = {d[0], d[1], d[2]}, .t_min = t_min, .t_max = t_max};
            }
            work(first, std::span<const Ray>(rays));
        });
    }
};

template <class T>
nb::dict cast_rays(const CompiledScene& scene, const RayRows& rays, int threads) {
    const NewArray<T> t_hit = new_array<T>(rays.rows.shape());
    const MetArrays<T> met(rays.rows.shape());
    rays.for_all(threads, [&](std::size_t first, std::span<const Ray> some) {
        thread_local std::vector<RayHit> hits;
        hits.resize(some.size());
        scene.closest_hit(some, hits);
        thread_local std::vector<Vec3> normals;
        normals.resize(some.size());
        outward_normals(scene, some, hits, normals);
        for (std::size_t i = 0; i < some.size(); ++i) {
            const std::size_t row = first + i;
            t_hit.values[row] = static_cast<T>(hits[i].t);
            if (hits[i].t == kInfinity) {
                met.set_nothing(row);
            } else {
                met.set(row, hits[i]);
                store(met.primitive_normals.values + 3 * row, normals[i]);
            }
        }
    });
    nb::dict answer;
    answer["t_hit"] = t_hit.array;
    met.put_into(answer);
    return answer;
}

// What limn.trimesh asks: the triangle of each ray, -1 for none, and t.
nb::object nearest(const CompiledScene& scene, const RayRows& rays, int threads) {
    const NewArray<std::int64_t> triangles = new_array<std::int64_t>(rays.rows.shape());
    const NewArray<double> t_hit = new_array<double>(rays.rows.shape());
    rays.for_all(threads, [&](std::size_t first, std::span<const Ray> some) {
        thread_local std::vector<RayHit> hits;
        hits.resize(some.size());
        scene.closest_hit(some, hits);
        for (std::size_t i = 0; i < some.size(); ++i) {
            const bool missed = hits[i].t == kInfinity;
            triangles.values[first + i] = missed ? -1 : static_cast<std::int64_t>(hits[i].element);
            t_hit.values[first + i] = hits[i].t;
        }
    });
    return nb::make_tuple(triangles.array, t_hit.array);
}

nb::object test_occlusions(const CompiledScene& scene, const RayRows& rays, int threads) {
    const NewArray<bool> occluded = new_array<bool>(rays.rows.shape());
    rays.for_all(threads, [&](std::size_t first, std::span<const Ray> some) {
        thread_local std::vector<std::uint8_t> answers;
        answers.resize(some.size());
        scene.any_hit(some, answers);
        for (std::size_t i = 0; i < some.size(); ++i) occluded.values[first + i] = answers[i] != 0;
    });
    return occluded.array;
}

nb::object count_intersections(const CompiledScene& scene, const RayRows& rays, int threads) {
    const NewArray<std::int64_t> counts = new_array<std::int64_t>(rays.rows.shape());
    rays.for_all(threads, [&](std::size_t first, std::span<const Ray> some) {
        thread_local std::vector<std::uint64_t> answers;
        answers.resize(some.size());
        scene.count_intersections(some, answers);
        for (std::size_t i = 0; i < some.size(); ++i) counts.values[first + i] = static_cast<std::int64_t>(answers[i]);
    });
    return counts.array;
}

template <class T>
nb::dict list_intersections(const CompiledScene& scene, const RayRows& rays, int threads) {
    std::vector<RayHits> parts((rays.rows.count() + kPart - 1) / kPart);
    rays.for_all(threads,
                 [&](std::size_t first, std::span<const Ray> some) { scene.all_hits(some, parts[first / kPart]); });
    std::vector<std::size_t> begin(parts.size() + 1, 0);  // of each part's hits among all
    for (std::size_t p = 0; p < parts.size(); ++p) begin[p + 1] = begin[p] + parts[p].hits.size();

    const std::vector<std::size_t> shape{begin.back()};
    const NewArray<std::int64_t> splits = new_array<std::int64_t>({rays.rows.count() + 1});
    const NewArray<std::int64_t> ray_ids = new_array<std::int64_t>(shape);
    const NewArray<T> t_hit = new_array<T>(shape);
    const MetArrays<T> met(shape, false);
    splits.values[0] = 0;
    for_all_rows(rays.rows.count(), threads, [&](std::size_t first, std::size_t count) {
        const RayHits& part = parts[first / kPart];
        for (std::size_t i = 0; i < count; ++i) {
            splits.values[first + i + 1] = static_cast<std::int64_t>(begin[first / kPart] + part.first[i + 1]);
            for (std::size_t h = part.first[i]; h < part.first[i + 1]; ++h) {
                const std::size_t row = begin[first / kPart] + h;
                ray_ids.values[row] = static_cast<std::int64_t>(first + i);
                t_hit.values[row] = static_cast<T>(part.hits[h].t);
                met.set(row, part.hits[h]);
            }
        }
    });
    nb::dict answer;
    answer["ray_splits"] = splits.array;
    answer["ray_ids"] = ray_ids.array;
    answer["t_hit"] = t_hit.array;
    met.put_into(answer);
    return answer;
}

}  // namespace

void bind_ray_queries(nb::class_<CompiledScene>& type) {
    type.def(
        "cast_rays",
        [](const CompiledScene& scene, ArrayArgument rays, CountArgument threads, NumberArgument t_min,
           NumberArgument t_max, NameArgument dtype) {
            const RayRows rows(rays, t_min, t_max, "t_min", "t_max");
            return nb::cast<nb::dict>(with_type(
                dtype, [&]<class T>(T) -> nb::object { return cast_rays<T>(scene, rows, thread_count(threads)); }));
        },
        given("rays"), given("threads") = 0, nb::kw_only(), given("t_min") = 0.0, given("t_max") = kInfinity,
        given("dtype") = "float64",
        R"(The nearest hit of each ray, exactly.

Args:
    rays: shape (..., 6), float64 or float32, C-contiguous: origin and direction, in the scene's units. The direction
        may have any length but zero. A ray with a NaN, or without a direction, misses.
    threads: on how many threads; 0 on all. The answers do not depend on it.
    t_min, t_max: hits count with t_min < t <= t_max, in units of the direction.
    dtype: "float64" or "float32", of the numbers in the answer.

Returns:
    A dict of arrays, `...` being the shape of the rays:
    t_hit (...): how far away, in units of the direction; inf where the ray misses.
    geometry_ids (...) uint32: the object, as Scene.add numbered it; 4294967295 where the ray misses.
    primitive_ids (...) uint32: the triangle of a mesh, as in its array; 4294967295 where the ray misses.
    primitive_uvs (..., 2): the weights of the triangle's second and third vertex.
    primitive_normals (..., 3): the unit normal of the outward side; zero where the ray misses.)");
    type.def(
        "_nearest",
        [](const CompiledScene& scene, ArrayArgument origins, ArrayArgument directions, CountArgument threads) {
            return nearest(scene, {origins, directions}, thread_count(threads));
        },
        given("ray_origins"), given("ray_directions"), given("threads"),
        nb::sig("def _nearest(self, ray_origins: numpy.typing.NDArray, ray_directions: numpy.typing.NDArray, "
                "threads: int) -> tuple[numpy.typing.NDArray, numpy.typing.NDArray]"),
        "The triangle that each ray hits first, -1 for none, and t. Both arrays (n, 3) float64. For limn.trimesh.");
    type.def(
        "_any",
        [](const CompiledScene& scene, ArrayArgument origins, ArrayArgument directions, CountArgument threads) {
            return test_occlusions(scene, {origins, directions}, thread_count(threads));
        },
        given("ray_origins"), given("ray_directions"), given("threads"),
        nb::sig("def _any(self, ray_origins: numpy.typing.NDArray, ray_directions: numpy.typing.NDArray, "
                "threads: int) -> numpy.typing.NDArray"),
        "test_occlusions with arrays as _nearest takes them.");
    type.def(
        "test_occlusions",
        [](const CompiledScene& scene, ArrayArgument rays, CountArgument threads, NumberArgument t_min,
           NumberArgument t_max) {
            return test_occlusions(scene, {rays, t_min, t_max, "t_min", "t_max"}, thread_count(threads));
        },
        given("rays"), given("threads") = 0, nb::kw_only(), given("t_min") = 0.0, given("t_max") = kInfinity,
        nb::sig("def test_occlusions(self, rays: numpy.typing.NDArray, threads: int = 0, *, t_min: float = 0.0, "
                "t_max: float = math.inf) -> numpy.typing.NDArray"),
        "Whether each ray hits anything with t_min < t <= t_max: bool, shape (...). Arguments as those of cast_rays.");
    type.def(
        "count_intersections",
        [](const CompiledScene& scene, ArrayArgument rays, CountArgument threads, NumberArgument t_min,
           NumberArgument t_max) {
            return count_intersections(scene, {rays, t_min, t_max, "t_min", "t_max"}, thread_count(threads));
        },
        given("rays"), given("threads") = 0, nb::kw_only(), given("t_min") = 0.0, given("t_max") = kInfinity,
        nb::sig("def count_intersections(self, rays: numpy.typing.NDArray, threads: int = 0, *, t_min: float = 0.0, "
                "t_max: float = math.inf) -> numpy.typing.NDArray"),
        R"(How many surfaces each ray passes through: int64, shape (...).

A passage through an edge or a vertex counts once; a ray that only touches a closed surface or runs along it enters and
leaves, or misses. So the number is even between two points outside of closed surfaces, and odd if one of them is inside.
It may differ from the number of hits that list_intersections gives. Arguments as those of cast_rays.)");
    type.def(
        "list_intersections",
        [](const CompiledScene& scene, ArrayArgument rays, CountArgument threads, NumberArgument t_min,
           NumberArgument t_max, NameArgument dtype) {
            const RayRows rows(rays, t_min, t_max, "t_min", "t_max");
            return nb::cast<nb::dict>(with_type(dtype, [&]<class T>(T) -> nb::object {
                return list_intersections<T>(scene, rows, thread_count(threads));
            }));
        },
        given("rays"), given("threads") = 0, nb::kw_only(), given("t_min") = 0.0, given("t_max") = kInfinity,
        given("dtype") = "float64",
        R"(Every hit of each ray, by t; at an edge or a vertex each triangle that the ray meets.

Arguments as those of cast_rays.

Returns:
    A dict of arrays over all m hits, ray after ray in the order of the flattened array:
    ray_splits (n + 1,) int64: the hits of ray i are those from ray_splits[i] to ray_splits[i + 1], not included.
    ray_ids (m,) int64: the ray. t_hit (m,), geometry_ids (m,), primitive_ids (m,), primitive_uvs (m, 2): as in cast_rays.)");
}

}  // namespace limn::python
