#include "kernels/light_choice.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/light_choice.cpp"
#include <hwy/foreach_target.h>

#include <cstddef>

#include "kernels/doubles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

using Floats = hn::Rebind<float, Doubles>;
using Indices = hn::Rebind<std::int32_t, Doubles>;

// Nodes by lane, as numbers of four bytes one after the other.
class Nodes {
public:
    static constexpr std::size_t kWords = sizeof(flat::LightNode) / 4;

    HWY_INLINE Nodes(const flat::LightTable& lights, W nodes)
        : base_(lights.nodes.data()),
          at_(hn::Mul(hn::DemoteTo(Indices(), nodes), hn::Set(Indices(), static_cast<int>(kWords)))) {}

    HWY_INLINE W number(std::size_t offset) const {
        return hn::PromoteTo(Doubles(),
                             hn::GatherIndex(Floats(), reinterpret_cast<const float*>(base_) + offset / 4, at_));
    }
    HWY_INLINE W3 three(std::size_t offset) const { return {number(offset), number(offset + 4), number(offset + 8)}; }
    HWY_INLINE W index(std::size_t offset) const {
        return hn::PromoteTo(
            Doubles(), hn::GatherIndex(Indices(), reinterpret_cast<const std::int32_t*>(base_) + offset / 4, at_));
    }

private:
    const flat::LightNode* base_;
    hn::Vec<Indices> at_;
};

struct Receivers {
    W3 position, normal;
    Where everywhere;  // light counts from all sides
};

struct Importances {
    W value;
    Where alike;
};

HWY_INLINE W at_most_one(W x) { return choose(hn::Lt(x, all(1.0)), x, all(1.0)); }

// importance_of in render/light_choice.cpp.
HWY_INLINE Importances importance_of(const Nodes& node, const Receivers& receiver) {
    const W zero = all(0.0), one = all(1.0);
    const W3 way = node.three(offsetof(flat::LightNode, center)) - receiver.position;
    const W3 half = node.three(offsetof(flat::LightNode, half));
    const W strength = node.number(offsetof(flat::LightNode, strength));
    const W spread = node.number(offsetof(flat::LightNode, cos_spread));
    const W d2 = length_squared(way), r2 = length_squared(half);
    const auto gap = [&](W along, W side) HWY_ATTR { return hn::Max(zero, hn::Abs(along) - side); };
    const W gap_x = gap(way.x, half.x), gap_y = gap(way.y, half.y), gap_z = gap(way.z, half.z);
    const W over_gap = one / hn::Sqrt(gap_x * gap_x + gap_y * gap_y + gap_z * gap_z);
    Importances i;
    i.value = strength / hn::Max(hn::Max(d2, r2), all(1e-300));
    i.alike = hn::And(hn::Le(all(kAlikeSquared) * r2, d2),
                      hn::Or(hn::Ge(spread, all(kAlikeSpread)), hn::Eq(spread, all(flat::kNoNormals))));
    const Where planes = hn::Gt(spread, zero);
    if (any(planes)) {
        const W3 axis = node.three(offsetof(flat::LightNode, axis));
        const W height = hn::Abs(dot(axis, way)) + dot(abs(axis), half);
        const W cosine = at_most_one(height * over_gap);
        const W turned = cosine * spread + hn::Sqrt((one - cosine * cosine) * (one - spread * spread));
        const W scaled = i.value * choose(hn::Eq(spread, one), cosine, turned);
        i.value = choose(hn::And(planes, hn::Lt(cosine, spread)), scaled, i.value);
    }
    const W middle = dot(receiver.normal, way), height = middle + dot(abs(receiver.normal), half);
    const Where behind = hn::Le(height, zero);
    const W before = choose(behind, zero, i.value * at_most_one(height * over_gap));
    i.value = choose(receiver.everywhere, i.value, before);
    i.alike = hn::Or(hn::And(receiver.everywhere, i.alike),
                     hn::AndNot(receiver.everywhere, hn::Or(behind, hn::And(i.alike, hn::Ge(middle, zero)))));
    // Beyond the range of float.
    const Where finite = hn::Lt(d2 + r2, all(kInfinity));
    return {choose(finite, i.value, strength), hn::And(finite, i.alike)};
}

void descend_lights(const flat::LightTable& lights, Lobe lobe, const VertexLanes& vertices, LightWays& ways) {
    const W zero = all(0.0), one = all(1.0);
    const hn::Rebind<std::uint32_t, Doubles> words;
    for (std::size_t i = 0; i < vertices.count; i += hn::Lanes(Doubles())) {
        Receivers receiver{LoadLane(vertices.position, i), LoadLane(vertices.normal, i), hn::Eq(zero, zero)};
        if (lobe == Lobe::lambertian) {
            const W3& n = receiver.normal;
            receiver.everywhere = hn::And(hn::And(hn::Eq(n.x, zero), hn::Eq(n.y, zero)), hn::Eq(n.z, zero));
        }
        W node = zero, begin = zero, probability = one, pick = LoadLane(vertices.numbers[0] + i);
        Importances here = importance_of(Nodes(lights, node), receiver);
        probability = choose(hn::Eq(here.value, zero), zero, probability);
        for (;;) {
            const Nodes at(lights, node);
            const W right = at.index(offsetof(flat::LightNode, right));
            const Where goes = hn::AndNot(here.alike, hn::And(hn::Gt(probability, zero), hn::Gt(right, zero)));
            if (!any(goes)) break;
            const W left = choose(goes, node + one, node);
            const Nodes at_left(lights, left);
            const Importances a = importance_of(at_left, receiver);
            const Importances b = importance_of(Nodes(lights, choose(goes, right, node)), receiver);
            const W sum = a.value + b.value, share = a.value / sum;
            const Where lost = hn::AndNot(hn::Gt(sum, zero), goes), to_left = hn::Lt(pick, share);
            const W rest = choose(to_left, pick / share, (pick - share) / (one - share));
            const W chance = probability * choose(to_left, share, one - share);
            probability = choose(goes, choose(lost, zero, chance), probability);
            pick = choose(goes, choose(hn::Lt(all(kLargestPick), rest), all(kLargestPick), rest), pick);
            begin = choose(hn::AndNot(to_left, goes), at_left.index(offsetof(flat::LightNode, end)), begin);
            node = choose(goes, choose(to_left, left, right), node);
            here.alike = hn::Or(hn::AndNot(goes, here.alike),
                                hn::And(goes, hn::Or(hn::And(to_left, a.alike), hn::AndNot(to_left, b.alike))));
        }
        StoreLane(probability, ways.probability + i);
        StoreLane(pick, ways.pick + i);
        hn::StoreU(hn::BitCast(words, hn::DemoteTo(Indices(), node)), words, ways.node + i);
        hn::StoreU(hn::BitCast(words, hn::DemoteTo(Indices(), begin)), words, ways.begin + i);
    }
}

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn::kernels {

HWY_EXPORT(descend_lights);

void descend_lights(const flat::LightTable& lights, Lobe lobe, const VertexLanes& vertices, LightWays& ways) {
    HWY_DYNAMIC_DISPATCH(descend_lights)(lights, lobe, vertices, ways);
}

}  // namespace limn::kernels
#endif
