// All kinds of primitives that have a row for each.
#pragma once

#include <tuple>
#include <type_traits>
#include <vector>

#include "primitives/disk.h"
#include "primitives/quad.h"
#include "primitives/sphere.h"
#include "primitives/triangle.h"

namespace limn::primitives {

// In the order of their names in CompiledScene::features().
using Tables = std::tuple<std::vector<Sphere>, std::vector<MovingSphere>, std::vector<Triangle>, std::vector<Quad>,
                          std::vector<Disk>>;

// visit(std::type_identity<Kind>()) with each.
template <class Visit>
constexpr void for_each_kind(const Visit& visit) {
    [&]<class... Kind>(std::type_identity<std::tuple<std::vector<Kind>...>>) {
        (visit(std::type_identity<Kind>()), ...);
    }(std::type_identity<Tables>());
}

// What it returns for the one that a value stands for, if any.
template <class Answer, class Visit>
constexpr Answer value_of_kind(PrimitiveKind kind, Answer otherwise, const Visit& visit) {
    for_each_kind([&]<class Kind>(std::type_identity<Kind> k) {
        if (kind == Kind::kKind) otherwise = visit(k);
    });
    return otherwise;
}

// visit(the row), if its kind has one.
template <class Visit>
void with_row(const Tables& tables, PrimitiveKind kind, std::size_t row, const Visit& visit) {
    for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
        if (kind == Kind::kKind) visit(std::get<std::vector<Kind>>(tables)[row]);
    });
}

}  // namespace limn::primitives
