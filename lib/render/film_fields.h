// The list of the fields of a FilmInfo. Writing, reading and comparing films use it.
#pragma once

#include <optional>

#include "limn/render/film.h"

namespace limn::transport {

// Calls function(name, field of a, the same field of b) for each field. Films of one render may differ in fields whose
// name is empty.
template <class A, class B, class Function>
void each_field(A& a, B& b, const Function& function) {
    function("", a.scene, b.scene);
    function("", a.features, b.features);
    function("width", a.width, b.width);
    function("height", a.height, b.height);
    function("scene", a.scene_digest, b.scene_digest);
    function("program", a.program, b.program);
    function("camera's place", a.camera.look_from, b.camera.look_from);
    function("camera's target", a.camera.look_at, b.camera.look_at);
    function("camera's up", a.camera.up, b.camera.up);
    function("field of view", a.camera.vertical_fov, b.camera.vertical_fov);
    function("aspect ratio", a.camera.aspect_ratio, b.camera.aspect_ratio);
    function("aperture angle", a.camera.aperture_angle, b.camera.aperture_angle);
    function("focus distance", a.camera.focus_distance, b.camera.focus_distance);
    function("shutter", a.camera.shutter_open, b.camera.shutter_open);
    function("shutter", a.camera.shutter_close, b.camera.shutter_close);
    function("projection", a.camera.projection, b.camera.projection);
    function("height of the view", a.camera.view_height, b.camera.view_height);
    function("depth limit", a.max_depth, b.max_depth);
    function("seed", a.seed, b.seed);
    function("antialiasing", a.antialias, b.antialias);
    function("estimator", a.estimator, b.estimator);
    function("sampler", a.sampler, b.sampler);
    function("choice of uniform sampling", a.uniform, b.uniform);
    function("crop window", a.crop, b.crop);
    function("choice of a transparent background", a.transparent, b.transparent);
    function("", a.shard.index, b.shard.index);
    function("", a.shard.count, b.shard.count);
}

template <class T>
constexpr bool kIsOptional = false;
template <class T>
constexpr bool kIsOptional<std::optional<T>> = true;

// Calls function(part) for each part of a field that is not a number. A part is a number or a bool or has parts itself.
template <class T, class Function>
void each_part(T& value, const Function& function) {
    using Plain = std::remove_const_t<T>;
    if constexpr (std::is_same_v<Plain, Hash128>) {
        function(value[0]);
        function(value[1]);
    } else if constexpr (kIsOptional<Plain>) {
        // An optional has two parts: a flag and a value. The value is default-constructed if there is none.
        bool given = value.has_value();
        auto content = value.value_or(typename Plain::value_type{});
        function(given);
        function(content);
        if constexpr (!std::is_const_v<T>) value = given ? std::optional(content) : std::nullopt;
    } else if constexpr (std::is_same_v<Plain, PixelBounds>) {
        function(value.left);
        function(value.top);
        function(value.right);
        function(value.bottom);
    } else {
        function(value.x);
        function(value.y);
        function(value.z);
    }
}

}  // namespace limn::transport
