// The parts of a compiled scene that are nothing but their bytes, listed once: for writing, reading and counting them.
// Their padding is named and zero, so that files of one scene are the same bytes.
#pragma once

#include "flat/scene.h"

namespace limn::flat {

// function(table) for each vector. Meshes, materials and what is shared with the description stand apart.
template <class S, class Function>
void each_table(S& s, const Function& function) {
    std::apply([&](auto&... rows) { (function(rows), ...); }, s.rows);
    function(s.instances), function(s.blases), function(s.ranges), function(s.references);
    function(s.nodes), function(s.blocks);
    function(s.first_of_object), function(s.object_of);
    function(s.medium_shapes), function(s.media), function(s.medium_instances);
    function(s.textures);
    function(s.list.entries), function(s.list.planar), function(s.list.round);
    function(s.lights.own), function(s.lights.places), function(s.lights.instances), function(s.lights.refs);
    function(s.lights.strength_before), function(s.lights.guide), function(s.lights.nodes),
        function(s.lights.by_number);
    function(s.lights.distant), function(s.light_sources);
    function(s.environment.row_luminance), function(s.environment.band_cosine), function(s.environment.band_before);
    function(s.environment.column_before);
}

// function(value) for each other one.
template <class S, class Function>
void each_value(S& s, const Function& function) {
    function(s.features), function(s.kinds), function(s.is_larger_than_cache);
    function(s.background_bottom), function(s.background_top), function(s.media_extent);
    function(s.list.quads), function(s.list.triangles), function(s.list.spheres);
    function(s.list.planar_stride), function(s.list.sphere_stride), function(s.list.is_all);
    function(s.list.rest_lower), function(s.list.rest_upper);
    function(s.digest), function(s.unmoved_digest), function(s.below_root);
    function(s.primitives), function(s.stored_primitives), function(s.degenerate), function(s.unassigned);
    function(s.memory_bytes), function(s.lights.strength);
    function(s.environment.axes), function(s.environment.scale), function(s.environment.luminance);
}

}  // namespace limn::flat
