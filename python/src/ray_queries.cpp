// Bindings of the queries of rays.
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

// The rays of a query, as arrays, and their range of t.
class RayRows {
public:
    Rows rows;                       // origins and directions, or origins alone if `directions` is set
    std::optional<Rows> directions;  // the directions if they are in another array
    double t_min = 0, t_max = kInfinity;

    // Takes two arrays, of origins and of directions.
    RayRows(ArrayArgument origins, ArrayArgument ways)
        : rows(origins, "ray_origins", 3, "an array, shape (n, 3)"),
          directions(std::in_place, ways, "ray_directions", 3, "an array, shape (n, 3)") {
        if (directions->shape() != rows.shape()) wrong_value("ray_directions", "must have the shape of ray_origins");
    }

    // Takes one array of rays, and t_min and t_max with the names that errors give them.
    RayRows(ArrayArgument rays, NumberArgument lowest, NumberArgument highest, const char* lowest_name,
            const char* highest_name)
        : rows(rays, "rays", 6, kRays), t_min(number(lowest, lowest_name)), t_max(number(highest, highest_name)) {
        if (!(t_min < kInfinity)) wrong_value(lowest_name, "must be a number below infinity");
        if (!(t_max >= t_min)) wrong_value(highest_name, "must be a number, not below " + std::string(lowest_name));
    }

    // Calls work(first, rays) for all parts of the rows. `first` is the row of the first ray. See for_all_rows.
    template <class Work>
    void for_all(int threads, const Work& work) const {
        rows.visit([&](const auto* numbers) {
            if (!directions) return for_all(threads, numbers, numbers + 3, 6, work);
            directions->visit([&](const auto* ways) { for_all(threads, numbers, ways, 3, work); });
        });
    }

private:
    // The same for given arrays. `stride` is the number of elements from one origin to the next, and from one direction
    // to the next.
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

// Answers cast_rays with numbers of type T.
template <class T>
nb::dict cast_rays(const CompiledScene& scene, const RayRows& rays, int threads) {
    const NewArray<T> t_hit = new_array<T>(rays.rows.shape());
    const MetArrays<T> met(rays.rows.shape());
    rays.for_all(threads, [&](std::size_t first, std::span<const Ray> some) {
        // Find the hits and their normals.
        thread_local std::vector<RayHit> hits;
        hits.resize(some.size());
        scene.closest_hit(some, hits);
        thread_local std::vector<Vec3> normals;
        normals.resize(some.size());
        outward_normals(scene, some, hits, normals);
        // Store them.
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

// Returns two arrays: the row of the triangle that each ray hits first, or -1; and its t, or inf. limn.trimesh
// calls this function.
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

// Answers list_intersections with numbers of type T.
template <class T>
nb::dict list_intersections(const CompiledScene& scene, const RayRows& rays, int threads) {
    // Find the hits of each part.
    std::vector<RayHits> parts((rays.rows.count() + kPart - 1) / kPart);
    rays.for_all(threads,
                 [&](std::size_t first, std::span<const Ray> some) { scene.all_hits(some, parts[first / kPart]); });
    // Count them. Part p has the hits from begin[p] to begin[p + 1] of the result.
    std::vector<std::size_t> begin(parts.size() + 1, 0);
    for (std::size_t p = 0; p < parts.size(); ++p) begin[p + 1] = begin[p] + parts[p].hits.size();

    // Store them, in parallel.
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
        R"(Returns the nearest hit of each ray, exactly.

The boundary of a ConstantMedium counts as a surface. Moving objects are at time 0.

Args:
    rays: origins and directions in world units: shape (..., 6), float64 or float32, C-contiguous. A direction may have
        any length but 0. A ray misses if a number is NaN, an origin or a direction is infinite, or a direction is 0.
    threads: number of threads, up to 1024. 0 uses all threads of the machine. The answers do not depend on it.
    t_min, t_max: a hit counts if t_min < t <= t_max. t is in units of the direction.
    dtype: type of the numbers in the answer, "float64" or "float32".

Returns:
    A dict of arrays. `...` is the shape of the rays.
    t_hit (...): the distance of the hit, in units of the direction; inf if the ray misses.
    geometry_ids (...) uint32: the number of the object, as Scene.add returned it; 4294967295 if the ray misses.
    primitive_ids (...) uint32: the number of the primitive within the object, for a mesh the row of its array of faces;
        4294967295 if the ray misses.
    primitive_uvs (..., 2): for a triangle the barycentric weights of its second and third vertex.
    primitive_normals (..., 3): the unit outward normal; 0 if the ray misses.)");
    type.def(
        "_nearest",
        [](const CompiledScene& scene, ArrayArgument origins, ArrayArgument directions, CountArgument threads) {
            return nearest(scene, {origins, directions}, thread_count(threads));
        },
        given("ray_origins"), given("ray_directions"), given("threads"),
        nb::sig("def _nearest(self, ray_origins: numpy.typing.NDArray, ray_directions: numpy.typing.NDArray, "
                "threads: int) -> tuple[numpy.typing.NDArray, numpy.typing.NDArray]"),
        "Returns two arrays: the row of the triangle that each ray hits first, or -1; and its t, or inf. Both "
        "arguments have shape (n, 3).");
    type.def(
        "_any",
        [](const CompiledScene& scene, ArrayArgument origins, ArrayArgument directions, CountArgument threads) {
            return test_occlusions(scene, {origins, directions}, thread_count(threads));
        },
        given("ray_origins"), given("ray_directions"), given("threads"),
        nb::sig("def _any(self, ray_origins: numpy.typing.NDArray, ray_directions: numpy.typing.NDArray, "
                "threads: int) -> numpy.typing.NDArray"),
        "Returns the same as test_occlusions for arrays of origins and directions, both of shape (n, 3).");
    type.def(
        "test_occlusions",
        [](const CompiledScene& scene, ArrayArgument rays, CountArgument threads, NumberArgument t_min,
           NumberArgument t_max) {
            return test_occlusions(scene, {rays, t_min, t_max, "t_min", "t_max"}, thread_count(threads));
        },
        given("rays"), given("threads") = 0, nb::kw_only(), given("t_min") = 0.0, given("t_max") = kInfinity,
        nb::sig("def test_occlusions(self, rays: numpy.typing.NDArray, threads: int = 0, *, t_min: float = 0.0, "
                "t_max: float = math.inf) -> numpy.typing.NDArray"),
        R"(Returns True for each ray that hits anything with t_min < t <= t_max: bool, shape (...).

The arguments are those of cast_rays.)");
    type.def(
        "count_intersections",
        [](const CompiledScene& scene, ArrayArgument rays, CountArgument threads, NumberArgument t_min,
           NumberArgument t_max) {
            return count_intersections(scene, {rays, t_min, t_max, "t_min", "t_max"}, thread_count(threads));
        },
        given("rays"), given("threads") = 0, nb::kw_only(), given("t_min") = 0.0, given("t_max") = kInfinity,
        nb::sig("def count_intersections(self, rays: numpy.typing.NDArray, threads: int = 0, *, t_min: float = 0.0, "
                "t_max: float = math.inf) -> numpy.typing.NDArray"),
        R"(Returns how often each ray passes through a surface: int64, shape (...).

A passage through an edge or a vertex counts once. A ray that touches a closed surface or runs along it counts as
passing through it twice or not at all. If all surfaces are closed, the number is even if both ends of the ray are
outside all of them, and odd if one end is outside and the other is inside exactly one of them. The number may differ
from the number of hits that list_intersections returns. The arguments are those of cast_rays.)");
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
        R"(Returns all hits of each ray, ordered by t.

A ray that passes through an edge or a vertex hits each of the triangles there. The arguments are those of cast_rays.

Returns:
    A dict of arrays with the m hits of all n rays, in the order of the rays.
    ray_splits (n + 1,) int64: the hits of ray i are those from ray_splits[i] to ray_splits[i + 1], the last one not
        included.
    ray_ids (m,) int64: the row of the ray in the flattened array of rays.
    t_hit (m,), geometry_ids (m,), primitive_ids (m,), primitive_uvs (m, 2): as in cast_rays.)");
}

}  // namespace limn::python
