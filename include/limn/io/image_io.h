/// \file
/// Image files. Written, by suffix: EXR and PNG; built without OpenImageIO: PNG and HDR. Read, by contents, whatever
/// the name: EXR (with OpenImageIO), PNG, JPEG, HDR, BMP and TGA, of which BMP unpacked. All functions are thread-safe,
/// for different files.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "limn/image/image.h"

namespace limn {

/// How stored values become linear ones. `automatic`: what the file says, else sRGB for 8-bit and 16-bit integer
/// formats and linear for floating point. `srgb` decodes the sRGB transfer, `raw` takes the values as they are.
enum class Encoding { automatic, srgb, raw };

/// Where a picture lies in a larger one, of which it is a part.
struct PartOf {
    /// In pixels: of the picture's upper left corner from that of the whole, and of the whole.
    ///@{
    int left = 0, top = 0, width = 0, height = 0;
    ///@}

    bool operator==(const PartOf&) const = default;  ///< the same place
};

/// What a picture is written with.
struct SaveOptions {
    bool half = false;  ///< EXR: half instead of float; save_image throws a FileError if a value is too large for it
    /// Facts about the picture, written as text: EXR attributes and PNG text named `limn:NAME`, HDR comments. NAME as
    /// in the `--report`, 1 to 70 printable characters. EXR does not keep an empty text, HDR no line breaks.
    std::vector<std::pair<std::string, std::string>> facts{};
    /// EXR: further channels, float in any case. Other formats have no place for them and leave them out.
    std::vector<ImageLayer> layers{};
    /// EXR and PNG: empty, or a value for each pixel, row by row, by which its colour is multiplied. EXR keeps colours
    /// so, PNG has them divided by it.
    std::vector<float> alpha{};
    double exposure = 0;  ///< in stops, of what is not linear: PNG shows colours multiplied by 2^exposure
    /// EXR: the data window is the picture's, the display window that of the whole.
    std::optional<PartOf> part_of{};
};

/// Writes a picture; PNG gets the sRGB transfer, and says so, clamped to [0, 1]; EXR is linear, with the primaries of
/// BT.709 stated. Float EXR keeps every bit, infinities and NaN too. The file appears whole or not at all: a temporary
/// file beside it (`.limn-*.tmp`; what a killed process leaves, the next one removes) is written, read back and
/// compared, flushed to disk and renamed. A file that is replaced keeps its permissions, and its owner where the system
/// lets it; a link is followed, also to where no file is yet. Only regular files are replaced: no pipe, no device.
///
/// \throws FileError naming the file: unknown suffix, unwritable, disk full, no pixels, non-finite values for PNG,
/// values too large for HDR
///
/// \throws ArgumentError if a fact's name or text or a layer's name cannot be written, alpha or a layer is not of the
/// picture's size, the picture does not lie in the whole, or the exposure is not finite
void save_image(const Image& image, const std::string& path, const SaveOptions& options = {});

/// \throws FileError where save_image would throw it for the name alone: an unknown suffix
void check_image_name(const std::string& path);

/// Whether a picture of that name keeps SaveOptions::layers. \throws FileError as check_image_name
bool image_holds_layers(const std::string& path);

/// \throws FileError where save_image would throw it for a reason that can be known beforehand: suffix, folder,
/// permissions
void check_writable(const std::string& path);

/// Reads the first three channels as stored, not multiplied by alpha; of fewer than three, the first as grey. A CMYK
/// JPEG is converted; an EXR's data window is the picture. An EXR with subsampled channels is refused. Only regular
/// files are read: no pipe, no device. A picture whose size the file cannot hold or the machine's memory cannot is
/// refused before memory is taken for it. Before a library decodes a file, limn has told its format by its contents and
/// checked its header. JPEG, HDR, BMP and TGA have no checksums: damage that leaves them readable is not noticed.
/// \throws FileError naming the file: missing, no picture (and what it appears to be), broken off, a wrong checksum
Image load_image(const std::string& path, Encoding encoding = Encoding::automatic);

/// The same from the bytes of a file, which messages call `name`.
Image load_image_from_memory(std::span<const std::byte> bytes, Encoding encoding = Encoding::automatic,
                             const std::string& name = "image in memory");

/// The alpha of a picture, as red, green and blue of an Image: as stored, from 0, where nothing is, to 1. std::nullopt
/// if it has no channel A; no JPEG, HDR and few BMP have one. Checked and refused as by load_image.
std::optional<Image> load_alpha(const std::string& path);

/// The same from the bytes of a file, which messages call `name`.
std::optional<Image> load_alpha_from_memory(std::span<const std::byte> bytes,
                                            const std::string& name = "image in memory");

/// One channel of a picture file.
struct ImageChannel {
    std::string name;  ///< "R", "G", "B"; "Y" where there is only grey; "A"; others as the file names them
    std::string type;  ///< of its values as stored: "uint8", "uint16", "half", "float" ...
};

/// What the header of a picture says.
struct ImageInfo {
    int width = 0;                       ///< in pixels
    int height = 0;                      ///< in pixels
    std::vector<ImageChannel> channels;  ///< in the order of the file
    std::optional<PartOf> part_of{};     ///< of an EXR whose data window is not its display window
    /// The text facts of a picture that save_image wrote, in no particular order.
    std::vector<std::pair<std::string, std::string>> facts{};
};

/// Reads size and channels, all of them, and decodes no pixels.
/// \throws FileError as load_image, but for what only pixels tell
ImageInfo load_image_info(const std::string& path);

/// The same from the bytes of a file, which messages call `name`.
ImageInfo load_image_info_from_memory(std::span<const std::byte> bytes, const std::string& name = "image in memory");

/// ImageInfo::facts of a picture. \throws FileError as load_image_info
std::vector<std::pair<std::string, std::string>> load_image_facts(const std::string& path);

}  // namespace limn
