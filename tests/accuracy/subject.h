// One geometry, ready to be asked about by everyone who is compared.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "accuracy/near_triangles.h"
#include "accuracy/question.h"
#include "limn/query/compiled_scene.h"
#include "support/exact_truth.h"

namespace limn::accuracy {

enum class Column {
    limn,           // the compiled scene and its trees
    limn_hit,       // the shape's own virtual hit()
    embree,         // default mode
    embree_robust,  // RTC_SCENE_FLAG_ROBUST
    moeller_trumbore,
    pluecker,
    book_sphere_float,
    book_sphere_double,
    book_quad
};
std::string name_of(Column column);

class Subject {
public:
    explicit Subject(Geometry geometry);

    const Geometry& geometry() const { return geometry_; }

    // The triangles that each ray may meet, those of ray i from first[i] to first[i + 1].
    struct Near {
        std::vector<std::uint32_t> triangles;
        std::vector<std::size_t> first;
    };
    void find_near(std::span<const Ray> rays, Near& near) const;

    // Everyone but Embree. `near` is for the textbook's triangles alone. \pre the column fits the kind of geometry
    void ask(Column column, std::span<const Ray> rays, const Near& near, std::vector<Answer>& answers) const;

    struct Truth {
        test::ExactHit hit;  // the nearest
        std::uint32_t primitive = 0;
    };
    Truth truth(const Ray& ray) const;
    test::ExactHit truth(const Ray& ray, std::uint32_t primitive) const;

private:
    std::uint32_t primitives() const;

    Geometry geometry_;
    std::shared_ptr<const Hittable> shape_;
    std::unique_ptr<const CompiledScene> scene_;
    NearTriangles near_;
    std::vector<Transform> chain_;
    float object_from_world_[3][4] = {};  // as a float32 program would store it
};

}  // namespace limn::accuracy
