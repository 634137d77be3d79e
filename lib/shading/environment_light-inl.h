// Directions towards an environment map, drawn by its luminance. The include guard is per target, as Highway requires.
#if defined(LIMN_SHADING_ENVIRONMENT_LIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_SHADING_ENVIRONMENT_LIGHT_INL_H
#undef LIMN_SHADING_ENVIRONMENT_LIGHT_INL_H
#else
#define LIMN_SHADING_ENVIRONMENT_LIGHT_INL_H
#endif

#include "math/equirectangular-inl.h"
#include "shading/light_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::lights::HWY_NAMESPACE {

using Indices = hn::Rebind<std::int32_t, Doubles::Tag>;

// Look up a table at whole numbers, which are at least 0.
HWY_INLINE Doubles gather(const std::vector<double>& table, Doubles at) {
    return hn::GatherIndex(Doubles::Tag(), table.data(), hn::ConvertTo(hn::Rebind<std::int64_t, Doubles::Tag>(), at.v));
}
HWY_INLINE Doubles gather(const std::vector<std::int32_t>& table, Doubles at) {
    return hn::PromoteTo(Doubles::Tag(), hn::GatherIndex(Indices(), table.data(), hn::DemoteTo(Indices(), at.v)));
}

// Returns the last of `count` indices for which is_before() holds, or 0 if there is none. \pre is_before() holds for no
// index after one for which it does not hold
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

// Returns a sample x in [0, 1] whose pdf is 2 ((1 - x) a + x b) / (a + b). It is uniform if a = b = 0.
// \pre a >= 0, b >= 0, u in [0, 1]
HWY_INLINE Doubles sample_linear(Doubles u, Doubles a, Doubles b) {
    const Doubles sum = a + b, root = sqrt((1.0 - u) * (a * a) + u * (b * b));
    return select(sum > 0.0, min(u * sum / (a + root), 1.0), u);
}

HWY_INLINE Doubles mix(Doubles a, Doubles b, Doubles weight) { return (1.0 - weight) * a + weight * b; }

template <>
struct InLanes<flat::EnvironmentLight> {
    const flat::Environment& map;  // the same in all lanes, because a scene has only one

    HWY_INLINE explicit InLanes(const LightsOf<flat::EnvironmentLight>& of) : map(*of[0].map) {}

    // Both inversions are monotonic, so points that are evenly spread stay so.
    HWY_INLINE LightPoints sample(const Vector<Doubles>&, Doubles a, Doubles b) const {
        // Sample a band, and a place in it.
        const std::size_t height = map.row_luminance.size(), width = static_cast<std::size_t>(map.image->width());
        const Doubles wanted = b * map.band_before.back();
        const Doubles number =
            last_before(height + 1, [&](Doubles at) HWY_ATTR { return gather(map.band_before, at) <= wanted; });
        const Doubles before = gather(map.band_before, number), all = gather(map.band_before, number + 1.0) - before;
        Band band(map, number, 0.0);
        const Doubles above = gather(map.row_luminance, band.upper), below = gather(map.row_luminance, band.lower);
        band.weight = sample_linear(min((wanted - before) / all, 1.0), above, below);
        const Doubles cosine = mix(gather(map.band_cosine, number), gather(map.band_cosine, number + 1.0), band.weight);

        // Sample a column, and a place in it. The sums along the row between two rows of pixels are in proportion to
        // the sum of both whole rows.
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

        // Compute the direction.
        const Doubles right = (column + 0.5 + along) / static_cast<double>(width);
        const Doubles sine = sqrt(max(0.0, 1.0 - cosine * cosine));
        const Vector<Doubles> own = map_direction(right, cosine, sine);
        LightPoints s;
        s.direction = own.x * broadcast<Doubles>(map.axes.x) + own.y * broadcast<Doubles>(map.axes.y) +
                      own.z * broadcast<Doubles>(map.axes.z);
        s.pdf = select(in_it > 0.0, mix(columns.left, columns.right, along) / map.luminance, 0.0);
        s.u = select(right < 1.0, right, right - 1.0);
        s.v = 1.0 - map_down(cosine, sine);
        s.end = kInfinity;
        return s;
    }

    HWY_INLINE Doubles pdf(const Vector<Doubles>&, const Vector<Doubles>& direction) const {
        // Find the place in the map.
        const double height = map.image->height(), width = map.image->width();
        const Vector<Doubles> own{dot(direction, broadcast<Doubles>(map.axes.x)),
                                  dot(direction, broadcast<Doubles>(map.axes.y)),
                                  dot(direction, broadcast<Doubles>(map.axes.z))};
        const MapPoint<Doubles> at = map_point(own);
        // Interpolate the luminance.
        const Doubles number = min(floor(at.down * height + 0.5), height);
        const Doubles upper = gather(map.band_cosine, number), lower = gather(map.band_cosine, number + 1.0);
        const Doubles cosine = own.y / sqrt(length_squared(own));
        const Band band(map, number, min(max((upper - cosine) / (upper - lower), 0.0), 1.0));
        const Doubles place = at.right * width - 0.5, column = floor(place);
        const Columns columns(map, band, select(column < 0.0, column + width, column));
        return mix(columns.left, columns.right, place - column) / map.luminance;
    }

private:
    // A place in a band of the map, which is between two rows of pixels.
    struct Band {
        Doubles upper, lower;  // the rows
        Doubles weight;        // weight of the lower row

        HWY_INLINE Band(const flat::Environment& map, Doubles band, Doubles weight_of_lower)
            : upper(max(band - 1.0, 0.0)),
              lower(min(band, static_cast<double>(map.image->height() - 1))),
              weight(weight_of_lower) {}
    };

    // The luminance in the centres of a column of pixels and the next column, at a place in a band.
    struct Columns {
        Doubles left, right;

        HWY_INLINE Columns(const flat::Environment& map, const Band& band, Doubles column) {
            constexpr std::size_t n = kLanes<Doubles>;
            HWY_ALIGN double upper[n], lower[n], weight[n], place[n], at[2][n];
            store(band.upper, upper);
            store(band.lower, lower);
            store(band.weight, weight);
            store(column, place);
            for (std::size_t i = 0; i < n; ++i) {
                const int first = static_cast<int>(place[i]);
                for (int k = 0; k < 2; ++k) {
                    const int x = first + k < map.image->width() ? first + k : 0;
                    const double above = luminance(map.image->at(x, static_cast<int>(upper[i])));
                    const double below = luminance(map.image->at(x, static_cast<int>(lower[i])));
                    at[k][i] = (1 - weight[i]) * above + weight[i] * below;
                }
            }
            left = load<Doubles>(at[0]);
            right = load<Doubles>(at[1]);
        }
    };
};

}  // namespace limn::lights::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
