// Bindings of the queries of points: inside or outside, and the distance to the surfaces.
#include <cmath>
#include <vector>

#include "parallel.h"
#include "queries.h"

namespace limn::python {

namespace {

constexpr const char* kPoints = "an array of points, shape (..., 3)";

Rows rows_of(ArrayArgument points) { return Rows(points, "points", 3, kPoints); }

// Calls work(row, point) for all points.
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

// Returns an array of ask(point) for all points.
template <class T, class Ask>
nb::object answer_each(const Rows& rows, int threads, const Ask& ask) {
    const NewArray<T> answers = new_array<T>(rows.shape());
    for_all_points(rows, threads,
                   [&](std::size_t row, const Point3& point) { answers.values[row] = static_cast<T>(ask(point)); });
    return answers.array;
}

// Returns the outward normal at the nearest point. Computes it as that of a ray from `from` that hits the point.
Vec3 normal_at(const CompiledScene& scene, const Point3& from, const ClosestPoint& nearest) {
    const RayHit hit{.t = 1,
                     .object = nearest.object,
                     .element = nearest.element,
                     .u = nearest.u,
                     .v = nearest.v,
                     .index_matched = nearest.index_matched,
                     .primitive = nearest.primitive};
    Vec3 way = nearest.position - from;
    if (way == Vec3{}) way = {1, 0, 0};  // the point is on the surface: any direction will do
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

// Returns the distance to the nearest surface, or infinity if there is none.
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
        R"(Returns True for each point that is inside a closed surface or exactly on a surface: bool, shape (...).

A point is inside if its winding number is not 0. The answer is exact for closed surfaces, also if they overlap. It has
no meaning if the surfaces are open (see open_edges). A point with a NaN is outside. Moving objects are at time 0.

Args:
    points: shape (..., 3), float64 or float32, C-contiguous, in world units.
    threads: number of threads, up to 1024. 0 uses all threads of the machine. The answers do not depend on it.)");
    type.def(
        "winding_number",
        [](const CompiledScene& scene, ArrayArgument points, CountArgument threads) {
            return answer_each<std::int64_t>(rows_of(points), thread_count(threads),
                                             [&](const Point3& point) { return scene.locate(point).winding_number; });
        },
        given("points"), given("threads") = 0,
        nb::sig("def winding_number(self, points: numpy.typing.NDArray, threads: int = 0) -> numpy.typing.NDArray"),
        R"(Returns the winding number of the surfaces around each point, exactly: int64, shape (...).

It is 0 outside, 1 inside a closed surface whose normals point outward, and -1 if they point inward. The numbers of
several surfaces are added. The arguments are those of contains.)");
    type.def(
        "compute_closest_points",
        [](const CompiledScene& scene, ArrayArgument points, CountArgument threads, NameArgument dtype) {
            const Rows rows = rows_of(points);
            return nb::cast<nb::dict>(with_type(dtype, [&]<class T>(T) -> nb::object {
                return compute_closest_points<T>(scene, rows, thread_count(threads));
            }));
        },
        given("points"), given("threads") = 0, nb::kw_only(), given("dtype") = "float64",
        R"(Returns the point of all surfaces that is nearest to each given point.

Moving objects are at time 0. A ValueError is raised if a sphere or disk that may be the nearest is in an Instance that
deforms it to another shape.

Args:
    points: shape (..., 3), float64 or float32, C-contiguous, in world units.
    threads: number of threads, up to 1024. 0 uses all threads of the machine. The answers do not depend on it.
    dtype: type of the numbers in the answer, "float64" or "float32".

Returns:
    A dict of arrays. "points" (..., 3) has the nearest points. "geometry_ids", "primitive_ids", "primitive_uvs" and
    "primitive_normals" are as in cast_rays. If the given point has a NaN, or the scene is empty, then the nearest point
    is NaN and the ids are 4294967295.)");
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
        R"(Returns the distance of each point from the nearest surface, in world units: shape (...).

The distance is inf if the point has a NaN or the scene is empty. The arguments are those of compute_closest_points.)");
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
        R"(Returns the distance of each point from the nearest surface, negative if the point is inside.

It is 0 if the point is exactly on a surface. Inside is defined by contains. The arguments are those of
compute_closest_points.)");
}

}  // namespace limn::python
