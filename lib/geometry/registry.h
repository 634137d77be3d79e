// The registry of all kinds of primitives that have a table with a row for each primitive.
#pragma once

#include <tuple>
#include <type_traits>
#include <vector>

#include "geometry/disk.h"
#include "geometry/quad.h"
#include "geometry/sphere.h"
#include "geometry/triangle.h"

namespace limn::primitives {

// The tables, in the order of the names in CompiledScene::features().
using Tables = std::tuple<std::vector<Sphere>, std::vector<MovingSphere>, std::vector<Triangle>, std::vector<Quad>,
                          std::vector<Disk>>;

// Calls visit(std::type_identity<Kind>()) for each kind.
template <class Visit>
constexpr void for_each_kind(const Visit& visit) {
    [&]<class... Kind>(std::type_identity<std::tuple<std::vector<Kind>...>>) {
        (visit(std::type_identity<Kind>()), ...);
    }(std::type_identity<Tables>());
}

// Returns visit(std::type_identity<Kind>()) for the type of the given kind, or `otherwise` if the kind isn't in the
// registry.
template <class Answer, class Visit>
constexpr Answer value_of_kind(PrimitiveKind kind, Answer otherwise, const Visit& visit) {
    for_each_kind([&]<class Kind>(std::type_identity<Kind> k) {
        if (kind == Kind::kKind) otherwise = visit(k);
    });
    return otherwise;
}

// Calls visit() with the given row of the table of `kind`. Does nothing if the kind has no table.
template <class Visit>
void with_row(const Tables& tables, PrimitiveKind kind, std::size_t row, const Visit& visit) {
    for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
        if (kind == Kind::kKind) visit(std::get<std::vector<Kind>>(tables)[row]);
    });
}

}  // namespace limn::primitives
