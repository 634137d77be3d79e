// The importance of a node and the way down by it after Conty Estevez and Kulla, Importance Sampling of Many Lights
// with Adaptive Tree Splitting, Proc. ACM Comput. Graph. Interact. Tech. 1(2), 2018. Ours: cosines are bounded by the
// box in place of a ball around it, so that lights close to a plane do not seem to shine along it, and the way down
// ends where all lights below are as good as alike.
#include "render/light_choice.h"

#include <algorithm>
#include <cmath>

namespace limn::transport {

namespace {

using flat::LightNode;
using flat::LightTable;

using shade::kAlikeSpread, shade::kAlikeSquared;

struct Importance {
    double value;
    bool alike;
};

// strength |cos at the light| cos at the receiver / distance^2. The distance is that of the box's middle, at least its
// half diagonal. The cosines are the largest that a point of the box can have: the height over the plane at most, over
// the distance at least. Zero only if the whole box is behind the receiver.
Importance importance_of(const LightNode& node, const Receiver& receiver) {
    const Vec3 way = Point3{node.center[0], node.center[1], node.center[2]} - receiver.position;
    const Vec3 half{node.half[0], node.half[1], node.half[2]};
    const double d2 = length_squared(way), r2 = length_squared(half);
    if (!std::isfinite(d2 + r2)) return {node.strength, false};  // beyond the range of float
    const auto gap = [&](std::size_t a) { return std::max(0.0, std::abs(way[a]) - half[a]); };
    const double over_gap = 1 / std::sqrt(gap(0) * gap(0) + gap(1) * gap(1) + gap(2) * gap(2));
    const double cos_spread = node.cos_spread;
    double value = node.strength / std::max({d2, r2, 1e-300});
    bool alike = kAlikeSquared * r2 <= d2 && (cos_spread >= kAlikeSpread || cos_spread == flat::kNoNormals);
    if (cos_spread > 0) {
        const Vec3 axis{node.axis[0], node.axis[1], node.axis[2]};
        const double height = std::abs(dot(axis, way)) + dot(abs(axis), half);
        const double cosine = std::min(1.0, height * over_gap);  // with the axis
        if (cosine < cos_spread)
            value *= cos_spread == 1
                         ? cosine
                         : cosine * cos_spread + std::sqrt((1 - cosine * cosine) * (1 - cos_spread * cos_spread));
    }
    if (receiver.normal == Vec3{}) return {value, alike};
    const double middle = dot(receiver.normal, way), height = middle + dot(abs(receiver.normal), half);
    if (height <= 0) return {0, true};
    return {value * std::min(1.0, height * over_gap), alike && middle >= 0};
}

// Where a way down stands: a node, its lights' ranks and the probability of having come there.
struct Walk {
    std::uint32_t node = 0;
    std::size_t begin = 0;
    double probability = 1;
};

// Goes down from the root until the lights are alike, and to the left wherever left(node, share, begin) says so; share
// is the left node's probability. False if there are no lights on the receiver's side.
template <class Left>
bool descend(const LightTable& lights, const Receiver& receiver, Walk& at, const Left& left) {
    Importance here = importance_of(lights.nodes[0], receiver);
    if (here.value == 0) return false;
    for (;;) {
        const std::uint32_t right = lights.nodes[at.node].right;
        if (right == 0 || here.alike) return true;
        const Importance a = importance_of(lights.nodes[at.node + 1], receiver),
                         b = importance_of(lights.nodes[right], receiver);
        const double sum = a.value + b.value;
        if (!(sum > 0)) return false;
        const double share = a.value / sum;
        if (left(lights.nodes[at.node + 1], share)) {
            at.node += 1, at.probability *= share;
            here = a;
        } else {
            at.begin = lights.nodes[at.node + 1].end;
            at.node = right, at.probability *= 1 - share;
            here = b;
        }
    }
}

// Of the lights where a way down ended, in proportion to their strength.
LightChoice choose_alike(const LightTable& lights, const Walk& at, double pick) {
    const auto first = lights.strength_before.begin() + static_cast<std::ptrdiff_t>(at.begin);
    const auto last = lights.strength_before.begin() + static_cast<std::ptrdiff_t>(lights.nodes[at.node].end);
    if (last - first == 1) return {at.begin, at.probability};
    const double strength = *last - *first, wanted = *first + pick * strength;
    // The guide narrows the search.
    const auto place =
        std::min(static_cast<std::size_t>(wanted * static_cast<double>(lights.size())), lights.size() - 1);
    const auto from = std::max(first, lights.strength_before.begin() + lights.guide[place]) + 1;
    const auto to = std::min(last, lights.strength_before.begin() + lights.guide[place + 1] + 1);
    const auto after = from < to ? std::upper_bound(from, to, wanted) : from < last ? from : last;
    return {static_cast<std::size_t>(after - 1 - lights.strength_before.begin()),
            at.probability * ((*after - *(after - 1)) / strength)};
}

}  // namespace

std::optional<LightChoice> choose_light(const LightTable& lights, const Receiver& receiver, double pick) {
    if (lights.nodes.empty()) return LightChoice{0, 1};
    Walk at;
    const bool found = descend(lights, receiver, at, [&](const LightNode&, double share) {
        const bool left = pick < share;
        // What is left of the number is as good as a new one.
        pick = std::min(left ? pick / share : (pick - share) / (1 - share), shade::kLargestPick);
        return left;
    });
    if (!found) return std::nullopt;
    return choose_alike(lights, at, pick);
}

void choose_lights(const LightTable& lights, shade::Lobe lobe, const shade::VertexLanes& vertices,
                   LightChoice* choices) {
    if (lights.nodes.empty()) {
        std::fill_n(choices, vertices.count, LightChoice{0, 1});
        return;
    }
    if (lights.nodes.size() > shade::kMostNodes) {
        for (std::size_t i = 0; i < vertices.count; ++i) {
            const Vec3 normal = lobe == shade::Lobe::lambertian ? vertices.normal.get<Vec3>(i) : Vec3{};
            const auto choice =
                choose_light(lights, {vertices.position.get<Point3>(i), normal}, vertices.numbers[0][i]);
            choices[i] = choice.value_or(LightChoice{0, 0});
        }
        return;
    }
    shade::LightWays ways;
    shade::descend_lights(lights, lobe, vertices, ways);
    for (std::size_t i = 0; i < vertices.count; ++i)
        choices[i] = ways.probability[i] > 0
                         ? choose_alike(lights, {ways.node[i], ways.begin[i], ways.probability[i]}, ways.pick[i])
                         : LightChoice{0, 0};
}

double probability_of(const LightTable& lights, const Receiver& receiver, std::size_t rank) {
    if (lights.nodes.empty()) return 1;
    Walk at;
    if (!descend(lights, receiver, at, [&](const LightNode& left, double) { return rank < left.end; })) return 0;
    const std::size_t end = lights.nodes[at.node].end;
    if (end - at.begin == 1) return at.probability;
    const std::vector<double>& before = lights.strength_before;
    return at.probability * (before[rank + 1] - before[rank]) / (before[end] - before[at.begin]);
}

}  // namespace limn::transport
