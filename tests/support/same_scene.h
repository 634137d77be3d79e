// What two compilations of one scene must share, in every bit.
#pragma once

#include <cstring>

#include "catch.h"
#include "flat/scene.h"
#include "limn/query/compiled_scene.h"

namespace limn::test {

template <class Table>
bool same_bytes(const Table& a, const Table& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

/// Compares digests, counts, trees and the tree of lights; not the time that compiling took.
inline void check_same(const CompiledScene& a, const CompiledScene& b) {
    CHECK(a.digest() == b.digest());
    CHECK(a.features() == b.features());
    CHECK(a.stats().primitives == b.stats().primitives);
    CHECK(a.stats().stored_primitives == b.stats().stored_primitives);
    CHECK(a.stats().degenerate == b.stats().degenerate);
    CHECK(a.stats().lights == b.stats().lights);
    CHECK(a.stats().memory_bytes == b.stats().memory_bytes);
    const flat::Scene &s = a.flat(), &t = b.flat();
    CHECK(same_bytes(s.nodes, t.nodes));
    CHECK(same_bytes(s.lines, t.lines));
    CHECK(same_bytes(s.references, t.references));
    CHECK(same_bytes(s.lights.nodes, t.lights.nodes));
    CHECK(s.kinds == t.kinds);
    CHECK(s.list.planar == t.list.planar);
    CHECK(s.list.round == t.list.round);
    CHECK(s.media.size() == t.media.size());
}

}  // namespace limn::test
