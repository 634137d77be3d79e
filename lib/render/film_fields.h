// The fields of a FilmInfo, listed once: for writing, reading and comparing.
#pragma once

#include <optional>

#include "limn/render/film.h"

namespace limn::transport {

// function(name, field of a, the same field of b) for each. Those without a name may differ between films of one
// render.
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
    function("depth limit", a.max_depth, b.max_depth);
    function("seed", a.seed, b.seed);
    function("antialiasing", a.antialias, b.antialias);
    function("estimator", a.estimator, b.estimator);
    function("sampler", a.sampler, b.sampler);
    function("choice of uniform sampling", a.uniform, b.uniform);
    function("", a.shard.index, b.shard.index);
    function("", a.shard.count, b.shard.count);
}

// function(part) for each part of a field that is no number.
template <class T, class Function>
void each_part(T& value, const Function& function) {
    using Plain = std::remove_const_t<T>;
    if constexpr (std::is_same_v<Plain, Hash128>) {
        function(value[0]), function(value[1]);
    } else if constexpr (std::is_same_v<Plain, std::optional<double>>) {
        // As a flag and a number.
        bool given = value.has_value();
        double number = value.value_or(0);
        function(given), function(number);
        if constexpr (!std::is_const_v<T>) value = given ? std::optional(number) : std::nullopt;
    } else {
        function(value.x), function(value.y), function(value.z);
    }
}

}  // namespace limn::transport
