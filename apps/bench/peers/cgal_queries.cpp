// cgal_queries INPUT OUTPUT: CGAL's AABB tree on the rays of a file, with exact predicates and inexact constructions.
// Built by apps/bench/queries.py alone and never installed: CGAL's trees are under the GPL.
//
// INPUT: counts of vertices, faces and rays as uint64, then float32 vertices, uint32 faces, float32 rays.
// OUTPUT: seconds of the nearest hits as double, then for each ray t as double (infinity: a miss) and its count as
// uint64.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>
#include <cstdint>
#include <fstream>
#include <limits>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Ray = Kernel::Ray_3;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

template <class T>
std::vector<T> read(std::ifstream& in, std::size_t count) {
    std::vector<T> values(count);
    in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
    return values;
}

// Along the ray, to the nearest of the points where it meets a triangle.
double nearest(const Tree& tree, const Ray& ray) {
    const auto hit = tree.first_intersection(ray);
    if (!hit) return std::numeric_limits<double>::infinity();
    const Kernel::Vector_3 way = ray.to_vector();
    const auto t = [&](const Point& p) { return (p - ray.source()) * way / way.squared_length(); };
    if (const Point* point = boost::get<Point>(&hit->first)) return t(*point);
    const auto& segment = boost::get<Kernel::Segment_3>(hit->first);
    return std::min(t(segment.source()), t(segment.target()));
}

int main(int, char** arguments) {
    std::ifstream in(arguments[1], std::ios::binary);
    const std::vector<std::uint64_t> sizes = read<std::uint64_t>(in, 3);
    const std::vector<float> v = read<float>(in, 3 * sizes[0]);
    const std::vector<std::uint32_t> f = read<std::uint32_t>(in, 3 * sizes[1]);
    const std::vector<float> r = read<float>(in, 6 * sizes[2]);
    const auto point = [&](std::uint32_t i) { return Point(v[3 * i], v[3 * i + 1], v[3 * i + 2]); };

    Triangles triangles;
    for (std::size_t i = 0; i < f.size(); i += 3) {
        const Kernel::Triangle_3 triangle(point(f[i]), point(f[i + 1]), point(f[i + 2]));
        if (!triangle.is_degenerate()) triangles.push_back(triangle);
    }
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < r.size(); i += 6)
        rays.emplace_back(Point(r[i], r[i + 1], r[i + 2]), Kernel::Vector_3(r[i + 3], r[i + 4], r[i + 5]));
    Tree tree(triangles.begin(), triangles.end());
    tree.build();

    std::vector<double> t(rays.size());
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < rays.size(); ++i) t[i] = nearest(tree, rays[i]);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

    std::ofstream out(arguments[2], std::ios::binary);
    out.write(reinterpret_cast<const char*>(&seconds), sizeof seconds);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const std::uint64_t count = tree.number_of_intersected_primitives(rays[i]);
        out.write(reinterpret_cast<const char*>(&t[i]), sizeof t[i]);
        out.write(reinterpret_cast<const char*>(&count), sizeof count);
    }
    return out.flush() ? 0 : 1;
}
