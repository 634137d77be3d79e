// cgal_queries INPUT: CGAL's AABB tree on the rays of a file, with exact predicates and inexact constructions. Built by
// apps/bench/bench.py alone and never installed: CGAL's trees are under the GPL.
//
// INPUT is text: counts of vertices, faces and rays, then vertices, faces and rays. Prints the seconds of the nearest
// hits, then for each ray t (inf for a miss) and its count of triangles.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Ray = Kernel::Ray_3;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

// Returns t of the nearest of the points where the ray meets a triangle.
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
    std::ifstream in(arguments[1]);
    const std::vector<double> all{std::istream_iterator<double>(in), {}};
    const double *v = &all[3], *faces = v + 3 * static_cast<long>(all[0]), *r = faces + 3 * static_cast<long>(all[1]);
    const auto point = [](const double* p) { return Point(p[0], p[1], p[2]); };
    Triangles triangles;
    for (const double* f = faces; f != r; f += 3) {
        const auto corner = [&](int i) { return point(v + 3 * static_cast<long>(f[i])); };
        const Kernel::Triangle_3 triangle(corner(0), corner(1), corner(2));
        if (!triangle.is_degenerate()) triangles.push_back(triangle);
    }
    std::vector<Ray> rays;
    for (; r != all.data() + all.size(); r += 6) rays.emplace_back(point(r), Kernel::Vector_3(r[3], r[4], r[5]));
    Tree tree(triangles.begin(), triangles.end());
    tree.build();

    std::vector<double> t;
    const auto begin = std::chrono::steady_clock::now();
    for (const Ray& ray : rays) t.push_back(nearest(tree, ray));
    std::printf("%.9g\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    for (std::size_t i = 0; i < rays.size(); ++i)
        std::printf("%.9g %zu\n", t[i], tree.number_of_intersected_primitives(rays[i]));
}
