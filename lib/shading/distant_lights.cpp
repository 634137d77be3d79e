#include "shading/distant_lights.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/distant_lights.cpp"
#include <hwy/foreach_target.h>

#include <bit>

#include "math/equirectangular-inl.h"
#include "math/rows-inl.h"
#include "math/spawn.h"
#include "math/warps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::lights::HWY_NAMESPACE {

using namespace sampling::HWY_NAMESPACE;

using Indices = hn::Rebind<std::int32_t, Doubles::Tag>;

// Of whole numbers from 0 on.
HWY_INLINE hn::Vec<Indices> index_of(Doubles whole) { return hn::DemoteTo(Indices(), whole.v); }

HWY_INLINE Doubles gather(const std::vector<double>& table, Doubles at) {
    return hn::GatherIndex(Doubles::Tag(), table.data(), hn::ConvertTo(hn::Rebind<std::int64_t, Doubles::Tag>(), at.v));
}
HWY_INLINE Doubles gather(const std::vector<std::int32_t>& table, Doubles at) {
    return hn::PromoteTo(Doubles::Tag(), hn::GatherIndex(Indices(), table.data(), index_of(at)));
}

// The last of `count` ascending places at which `is_before` still holds; 0 if it holds nowhere.
template <class IsBefore>
HWY_INLINE Doubles last_before(std::size_t count, const IsBefore& is_before) {
    const double last = static_cast<double>(count - 1);
    Doubles at = 0.0;
    for (std::size_t step = std::bit_floor(count); step > 0; step /= 2) {
        const Doubles next = at + static_cast<double>(step);
        at = select((next <= last) & is_before(min(next, last)), next, at);
    }
    return at;
}

// Of a density that goes linearly from a to b over [0, 1].
HWY_INLINE Doubles sample_linear(Doubles u, Doubles a, Doubles b) {
    const Doubles sum = a + b, root = sqrt((1.0 - u) * (a * a) + u * (b * b));
    return select(sum > 0.0, min(u * sum / (a + root), 1.0), u);
}

HWY_INLINE Doubles mix(Doubles a, Doubles b, Doubles weight) { return (1.0 - weight) * a + weight * b; }

// A band of the map between two rows of pixels, and where in it.
struct Band {
    Doubles upper, lower;  // rows
    Doubles weight;        // of the lower one

    HWY_INLINE Band(const flat::Environment& map, Doubles band, Doubles of_lower)
        : upper(max(band - 1.0, 0.0)),
          lower(min(band, static_cast<double>(map.image->height() - 1))),
          weight(of_lower) {}
};

// The density along a column of pixels and the next one, at their place in a band.
struct Columns {
    Doubles left, right;

    HWY_INLINE Columns(const flat::Environment& map, const Band& band, Doubles column) {
        HWY_ALIGN double upper[8], lower[8], weight[8], place[8], at[2][8];
        store(band.upper, upper), store(band.lower, lower), store(band.weight, weight), store(column, place);
        for (std::size_t i = 0; i < kLanes<Doubles>; ++i) {
            const int first = static_cast<int>(place[i]);
            for (int k = 0; k < 2; ++k) {
                const int x = first + k < map.image->width() ? first + k : 0;
                const double above = luminance(map.image->at(x, static_cast<int>(upper[i])));
                const double below = luminance(map.image->at(x, static_cast<int>(lower[i])));
                at[k][i] = (1 - weight[i]) * above + weight[i] * below;
            }
        }
        left = load<Doubles>(at[0]), right = load<Doubles>(at[1]);
    }
};

struct Drawn {
    Vector<Doubles> direction;
    Doubles pdf, u, v;
};

// Both inversions are monotonic, so that points that are evenly spread stay so.
HWY_INLINE Drawn sample_map(const flat::Environment& map, Doubles a, Doubles b) {
    const std::size_t height = map.row_luminance.size(), width = static_cast<std::size_t>(map.image->width());
    const Doubles wanted = b * map.band_before.back();
    const Doubles number =
        last_before(height + 1, [&](Doubles at) HWY_ATTR { return gather(map.band_before, at) <= wanted; });
    const Doubles before = gather(map.band_before, number), all = gather(map.band_before, number + 1.0) - before;
    Band band(map, number, 0.0);
    const Doubles above = gather(map.row_luminance, band.upper), below = gather(map.row_luminance, band.lower);
    band.weight = sample_linear(min((wanted - before) / all, 1.0), above, below);
    const Doubles cosine = mix(gather(map.band_cosine, number), gather(map.band_cosine, number + 1.0), band.weight);

    // Sums along the row that lies between two, as shares of both together.
    const Doubles of_upper = (1.0 - band.weight) * above, of_lower = band.weight * below;
    const double stride = static_cast<double>(width + 1);
    const auto sum_before = [&](Doubles at) HWY_ATTR {
        return of_upper * gather(map.column_before, band.upper * stride + at) +
               of_lower * gather(map.column_before, band.lower * stride + at);
    };
    const Doubles share = a * (double{flat::Environment::kWhole} * (of_upper + of_lower));
    const Doubles column = last_before(width, [&](Doubles at) HWY_ATTR { return sum_before(at) <= share; });
    const Doubles left_of_it = sum_before(column), in_it = sum_before(column + 1.0) - left_of_it;
    const Columns columns(map, band, column);
    const Doubles along = sample_linear(min((share - left_of_it) / in_it, 1.0), columns.left, columns.right);

    const Doubles right = (column + 0.5 + along) / static_cast<double>(width);
    const Doubles sine = sqrt(max(0.0, 1.0 - cosine * cosine));
    const Vector<Doubles> own = map_direction(right, cosine, sine);
    Drawn drawn;
    drawn.direction = own.x * broadcast<Doubles>(map.axes.x) + own.y * broadcast<Doubles>(map.axes.y) +
                      own.z * broadcast<Doubles>(map.axes.z);
    drawn.pdf = select(in_it > 0.0, mix(columns.left, columns.right, along) / map.luminance, 0.0);
    drawn.u = select(right < 1.0, right, right - 1.0), drawn.v = 1.0 - map_down(cosine, sine);
    return drawn;
}

HWY_INLINE Doubles map_pdf(const flat::Environment& map, const Vector<Doubles>& direction) {
    const double height = map.image->height(), width = map.image->width();
    const Vector<Doubles> own{dot(direction, broadcast<Doubles>(map.axes.x)),
                              dot(direction, broadcast<Doubles>(map.axes.y)),
                              dot(direction, broadcast<Doubles>(map.axes.z))};
    const MapPoint<Doubles> at = map_point(own);
    const Doubles number = min(floor(at.down * height + 0.5), height);
    const Doubles upper = gather(map.band_cosine, number), lower = gather(map.band_cosine, number + 1.0);
    const Doubles cosine = own.y / sqrt(length_squared(own));
    const Band band(map, number, min(max((upper - cosine) / (upper - lower), 0.0), 1.0));
    const Doubles place = at.right * width - 0.5, column = floor(place);
    const Columns columns(map, band, select(column < 0.0, column + width, column));
    return mix(columns.left, columns.right, place - column) / map.luminance;
}

// Which lanes have a distant light, and what is known of it.
struct DistantLanes {
    Vector<Doubles> towards;
    Doubles one_minus_cos, kind;

    HWY_INLINE DistantLanes(const flat::Light* const* lights, std::size_t count) {
        HWY_ALIGN double fields[5][8] = {};
        for (std::size_t i = 0; i < kLanes<Doubles> && i < count; ++i) {
            if (!lights[i]) continue;
            const flat::Light& l = *lights[i];
            fields[0][i] = l.edge_u.x, fields[1][i] = l.edge_u.y, fields[2][i] = l.edge_u.z;
            fields[3][i] = l.radius, fields[4][i] = static_cast<double>(l.kind);
        }
        towards = {load<Doubles>(fields[0]), load<Doubles>(fields[1]), load<Doubles>(fields[2])};
        one_minus_cos = load<Doubles>(fields[3]), kind = load<Doubles>(fields[4]);
    }
    HWY_INLINE Mask<Doubles> any_kind() const { return kind >= static_cast<double>(flat::LightKind::directional); }
    HWY_INLINE Mask<Doubles> is(flat::LightKind k) const { return kind == static_cast<double>(k); }
};

void sample_distant(const flat::Environment& map, const Receivers& receivers, LightSamples& samples) {
    for (std::size_t i = 0; i < receivers.count; i += kLanes<Doubles>) {
        const DistantLanes light(samples.light + i, receivers.count - i);
        const Mask<Doubles> distant = light.any_kind();
        store(select(distant, Doubles(kInfinity), 1 - kShadowEnd), samples.end + i);
        if (!any(distant)) continue;
        const Doubles a = load<Doubles>(samples.numbers[1] + i), b = load<Doubles>(samples.numbers[2] + i);
        Drawn drawn{light.towards, 1 / flat::kNoSolidAngle, 0.0, 0.0};
        const Mask<Doubles> sun = light.is(flat::LightKind::sun), around = light.is(flat::LightKind::environment);
        if (any(sun)) {
            const Vector<Doubles> local = uniform_cone(a, b, light.one_minus_cos);
            drawn.direction = select(sun, Basis<Doubles>(light.towards).to_world(local), drawn.direction);
            drawn.pdf = select(sun, uniform_cone_pdf(light.one_minus_cos), drawn.pdf);
        }
        if (any(around)) {
            const Drawn of_map = sample_map(map, a, b);
            drawn.direction = select(around, of_map.direction, drawn.direction);
            drawn.pdf = select(around, of_map.pdf, drawn.pdf);
            drawn.u = of_map.u, drawn.v = of_map.v;
        }
        store3(select(distant, drawn.direction, load3<Doubles>(samples.direction, i)), samples.direction, i);
        store(select(distant, drawn.pdf, load<Doubles>(samples.pdf + i)), samples.pdf + i);
        store(select(around, drawn.u, load<Doubles>(samples.u + i)), samples.u + i);
        store(select(around, drawn.v, load<Doubles>(samples.v + i)), samples.v + i);
    }
}

void find_distant_pdf(const flat::Environment& map, std::size_t count, const flat::Light* const* lights,
                      LightHits& hits) {
    for (std::size_t i = 0; i < count; i += kLanes<Doubles>) {
        const DistantLanes light(lights + i, count - i);
        const Mask<Doubles> sun = light.is(flat::LightKind::sun), around = light.is(flat::LightKind::environment);
        Doubles pdf = select(sun, uniform_cone_pdf(light.one_minus_cos), load<Doubles>(hits.pdf + i));
        if (any(around)) {
            const Vector<Doubles> direction = load3<Doubles>(hits.position, i), some{0.0, 1.0, 0.0};
            pdf = select(around, map_pdf(map, select(around, direction, some)), pdf);
        }
        store(pdf, hits.pdf + i);
    }
}

}  // namespace limn::lights::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn::lights {

HWY_EXPORT(sample_distant);
HWY_EXPORT(find_distant_pdf);

void sample_distant(const flat::Environment& map, const Receivers& receivers, LightSamples& samples) {
    HWY_DYNAMIC_DISPATCH(sample_distant)(map, receivers, samples);
}

void find_distant_pdf(const flat::Environment& map, std::size_t count, const flat::Light* const* lights,
                      LightHits& hits) {
    HWY_DYNAMIC_DISPATCH(find_distant_pdf)(map, count, lights, hits);
}

}  // namespace limn::lights
#endif
