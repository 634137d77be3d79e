#include "io/vertex_colors.h"

#include <array>
#include <cmath>
#include <unordered_map>

#include "io/bytes_hash.h"
#include "limn/scene/material/lambertian.h"
#include "limn/scene/texture/image_texture.h"

namespace limn {

namespace {

using Corners = std::array<Float3, 3>;  // the colours of the corners of a triangle

// A texture that is divided into squares of two by two texels, numbered row by row. Each square holds the colours of a
// triangle.
class Atlas {
public:
    explicit Atlas(std::size_t squares)
        : columns_(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(squares))))),
          rows_(static_cast<int>((squares + static_cast<std::size_t>(columns_) - 1) /
                                 static_cast<std::size_t>(columns_))),
          image_(2 * columns_, 2 * rows_) {}

    // Stores the colours of a triangle. Its corners are at the centres of three texels; the fourth texel continues the
    // linear interpolation.
    void set(std::size_t square, const Corners& c) {
        const auto [x, y] = texel(square);
        const auto color = [](const Float3& v) { return Color{v.x, v.y, v.z}; };
        image_.set(x, y, color(c[0]));
        image_.set(x + 1, y, color(c[1]));
        image_.set(x, y + 1, color(c[2]));
        image_.set(x + 1, y + 1, color(c[1]) + color(c[2]) - color(c[0]));
    }

    // Returns the texture coordinates of the corners.
    std::array<Float2, 3> uvs(std::size_t square) const {
        const auto [x, y] = texel(square);
        const auto at = [&](int column, int row) {
            return Float2{static_cast<float>((column + 0.5) / image_.width()),
                          static_cast<float>(1 - (row + 0.5) / image_.height())};
        };
        return {at(x, y), at(x + 1, y), at(x, y + 1)};
    }

    Image take() { return std::move(image_); }

private:
    // Returns the column and the row of a square's upper left texel.
    std::pair<int, int> texel(std::size_t square) const {
        const std::size_t columns = static_cast<std::size_t>(columns_);
        return {2 * static_cast<int>(square % columns), 2 * static_cast<int>(square / columns)};
    }

    int columns_, rows_;
    Image image_;
};

}  // namespace

std::shared_ptr<const Material> paint(MeshData& mesh, const std::vector<Float3>& colors) {
    // Assign a square to each combination of three colours.
    std::unordered_map<Corners, std::size_t, BytesHash> squares;
    std::vector<std::size_t> square_of;
    for (const Index3& t : mesh.triangles) {
        const auto [place, is_new] = squares.try_emplace({colors[t.a], colors[t.b], colors[t.c]}, squares.size());
        square_of.push_back(place->second);
    }
    // Fill the texture.
    Atlas atlas(squares.size());
    for (const auto& [corners, square] : squares) atlas.set(square, corners);
    // Give each triangle vertices of its own, with the texture coordinates of its square.
    MeshData painted;
    painted.faces = std::move(mesh.faces);
    painted.material_slots.assign(mesh.triangles.size(), 1);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Index3& t = mesh.triangles[i];
        const auto first = static_cast<std::uint32_t>(3 * i);
        painted.triangles.push_back({first, first + 1, first + 2});
        for (const std::uint32_t corner : {t.a, t.b, t.c}) {
            painted.vertices.push_back(mesh.vertices[corner]);
            if (!mesh.normals.empty()) painted.normals.push_back(mesh.normals[corner]);
        }
        for (const Float2& uv : atlas.uvs(square_of[i])) painted.uvs.push_back(uv);
    }
    mesh = std::move(painted);
    return std::make_shared<Lambertian>(
        std::make_shared<ImageTexture>(atlas.take(), ImageTextureOptions{Filter::bilinear, Wrap::clamp}));
}

}  // namespace limn
