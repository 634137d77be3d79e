// What points are inside of, and how far away surfaces are.
#include <cmath>
#include <vector>

#include "parallel.h"
#include "queries.h"

namespace limn::python {

namespace {

constexpr const char* kPoints = "an array of points, shape (..., 3)";

Rows rows_of(ArrayArgument points) { return Rows(points, "points", 3, kPoints); }

// work(row, point) for all.
template <class Work>
void for_all_points(const Rows& rows, int threads, const Work& work) {
    rows.visit([&](const auto* numbers) {
        for_all_rows(rows.count(), threads, [&](std::size_t first, std::size_t count) {
            for (std::size_t row = first; row < first + count; ++row) {
                const auto* p = numbers + 3 * row;
                work(row, Point3{p[0], p[1], p[2]});
            }
        });
    });
}

template <class T, class Ask>
nb::object answer_each(const Rows& rows, int threads, const Ask& ask) {
    const NewArray<T> answers = new_array<T>(rows.shape());
    for_all_points(rows, threads,
                   [&](std::size_t row, const Point3& point) { answers.values[row] = static_cast<T>(ask(point)); });
    return answers.array;
}

// The outward normal where a point was found: that of a ray which arrives there.
Vec3 normal_at(const CompiledScene& scene, const Point3& from, const ClosestPoint& nearest) {
    const RayHit hit{.t = 1,
                     .object = nearest.object,
                     .element = nearest.element,
                     .u = nearest.u,
                     .v = nearest.v,
                     .index_matched = nearest.index_matched,
                     .primitive = nearest.primitive};
    Vec3 way = nearest.position - from;
    if (way == Vec3{}) way = {1, 0, 0};
    return outward_normal(scene, Ray{.origin = nearest.position - way, .direction = way}, hit);
}

template <class T>
nb::dict compute_closest_points(const CompiledScene& scene, const Rows& rows, int threads) {
    const NewArray<T> points = new_array<T>(rows.shape(), 3);
    const MetArrays<T> met(rows.shape());
    for_all_points(rows, threads, [&](std::size_t row, const Point3& point) {
        const std::optional<ClosestPoint> nearest = scene.closest_point(point);
        if (!nearest) {
            store(points.values + 3 * row, Vec3{std::nan(""), std::nan(""), std::nan("")});
            return met.set_nothing(row);
        }
        store(points.values + 3 * row, nearest->position - Point3{});
        met.set(row, {.object = nearest->object, .element = nearest->element, .u = nearest->u, .v = nearest->v});
        store(met.primitive_normals.values + 3 * row, normal_at(scene, point, *nearest));
    });
    nb::dict answer;
    answer["points"] = points.array;
    met.put_into(answer);
    return answer;
}

double distance(const CompiledScene& scene, const Point3& point) {
    const std::optional<ClosestPoint> nearest = scene.closest_point(point);
    return nearest ? nearest->distance : kInfinity;
}

}  // namespace

void bind_point_queries(nb::class_<CompiledScene>& type) {
    type.def(
        "contains",
        [](const CompiledScene& scene, ArrayArgument points, CountArgument threads) {
            return answer_each<bool>(rows_of(points), thread_count(threads),
                                     [&](const Point3& point) { return scene.contains(point); });
        },
        given("points"), given("threads") = 0,
        nb::sig("def contains(self, points: numpy.typing.NDArray, threads: int = 0) -> numpy.typing.NDArray"),
        R"(Whether each point is inside of a closed surface, or exactly on a surface: bool, shape (...).

By winding numbers, exactly. Where surfaces are open (see open_edges) inside means nothing. A point with a NaN is outside.

Args:
    points: shape (..., 3), float64 or float32, C-contiguous, in the scene's units.
    threads: on how many threads; 0 on all. The answers do not depend on it.)");
    type.def(
        "winding_number",
        [](const CompiledScene& scene, ArrayArgument points, CountArgument threads) {
            return answer_each<std::int64_t>(rows_of(points), thread_count(threads),
                                             [&](const Point3& point) { return scene.locate(point).winding_number; });
        },
        given("points"), given("threads") = 0,
        nb::sig("def winding_number(self, points: numpy.typing.NDArray, threads: int = 0) -> numpy.typing.NDArray"),
        "How often surfaces wind around each point, exactly: int64, shape (...). Arguments as those of contains.");
    type.def(
        "compute_closest_points",
        [](const CompiledScene& scene, ArrayArgument points, CountArgument threads, NameArgument dtype) {
            const Rows rows = rows_of(points);
            return nb::cast<nb::dict>(with_type(dtype, [&]<class T>(T) -> nb::object {
                return compute_closest_points<T>(scene, rows, thread_count(threads));
            }));
        },
        given("points"), given("threads") = 0, nb::kw_only(), given("dtype") = "float64",
        R"(The nearest point of all surfaces to each point.

Args:
    points: shape (..., 3), float64 or float32, C-contiguous, in the scene's units.
    threads: on how many threads; 0 on all. The answers do not depend on it.
    dtype: "float64" or "float32", of the numbers in the answer.

Returns:
    A dict of arrays: points (..., 3), the nearest ones; geometry_ids, primitive_ids, primitive_uvs and primitive_normals
    as in cast_rays. For a point with a NaN, and in an empty scene: NaN, and ids of 4294967295.)");
    type.def(
        "compute_distance",
        [](const CompiledScene& scene, ArrayArgument points, CountArgument threads, NameArgument dtype) {
            const Rows rows = rows_of(points);
            return with_type(dtype, [&]<class T>(T) {
                return answer_each<T>(rows, thread_count(threads), [&](const Point3& p) { return distance(scene, p); });
            });
        },
        given("points"), given("threads") = 0, nb::kw_only(), given("dtype") = "float64",
        nb::sig("def compute_distance(self, points: numpy.typing.NDArray, threads: int = 0, *, dtype: str = 'float64') "
                "-> numpy.typing.NDArray"),
        "How far each point is from the nearest surface, in the scene's units: shape (...); inf for a point with a "
        "NaN, "
        "and in an empty scene. Arguments as those of compute_closest_points.");
    type.def(
        "compute_signed_distance",
        [](const CompiledScene& scene, ArrayArgument points, CountArgument threads, NameArgument dtype) {
            const Rows rows = rows_of(points);
            return with_type(dtype, [&]<class T>(T) {
                return answer_each<T>(rows, thread_count(threads),
                                      [&](const Point3& p) { return scene.signed_distance(p); });
            });
        },
        given("points"), given("threads") = 0, nb::kw_only(), given("dtype") = "float64",
        nb::sig("def compute_signed_distance(self, points: numpy.typing.NDArray, threads: int = 0, *, "
                "dtype: str = 'float64') -> numpy.typing.NDArray"),
        "compute_distance, negative where contains is true; 0 exactly on a surface.");
}

}  // namespace limn::python
