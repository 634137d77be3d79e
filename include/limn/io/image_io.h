/// \file
/// Reading and writing image files. Implemented in lib/io/image_file.cpp and save_image.cpp.
///
/// - The suffix of a file's name decides the format in which it is written: EXR or PNG; PNG or HDR in a build without
///   OpenImageIO.
/// - The contents of a file decide the format in which it is read: EXR (with OpenImageIO), PNG, JPEG, HDR, TGA and
///   uncompressed BMP.
/// - Threads may call all functions at the same time, for different files.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "limn/image/image.h"

namespace limn {

/// The way in which stored values are converted to linear ones.
///
/// - `automatic`: as the file says; if it says nothing, sRGB for integers and linear for floating point.
/// - `srgb`: decodes the sRGB transfer function.
/// - `raw`: takes the values as they are.
enum class Encoding { automatic, srgb, raw };

/// The place of a picture in a larger picture, the whole.
struct PartOf {
    /// `left` and `top` are the column and row of the whole in which the picture's upper left pixel is. `width` and
    /// `height` are the size of the whole in pixels.
    ///@{
    int left = 0, top = 0, width = 0, height = 0;
    ///@}

    bool operator==(const PartOf&) const = default;  ///< compares all members
};

/// Options of save_image.
struct SaveOptions {
    bool half = false;  ///< EXR: store half instead of float; no finite value may exceed 65504
    /// Facts about the picture: pairs of a name and a text. They are written as attributes of an EXR or text of a PNG,
    /// called `limn:NAME`, or as comments of an HDR. A name has 1 to 70 printable ASCII characters without blanks. A
    /// text has no zero byte. An EXR loses an empty text; an HDR has blanks instead of line breaks.
    std::vector<std::pair<std::string, std::string>> facts{};
    /// EXR: further channels, always stored as float. Other formats don't store them.
    std::vector<ImageLayer> layers{};
    /// EXR and PNG: empty, or the alpha of each pixel, row by row. The image's colours are multiplied by it (associated
    /// alpha). An EXR stores them like this; a PNG stores them divided by alpha. An HDR stores no alpha.
    std::vector<float> alpha{};
    double exposure = 0;  ///< PNG: in stops; colours are multiplied by 2^exposure
    /// EXR: the whole of which the picture is a part. The data window is the picture, the display window is the whole.
    std::optional<PartOf> part_of{};
};

/// Writes a picture to a file.
///
/// - An EXR is linear and states the primaries of BT.709. A float EXR keeps every bit, infinities and NaN too.
/// - A PNG has 8 bits with the sRGB transfer function, clamped to [0, 1], and says so.
/// - An HDR has one exponent and three mantissas of 8 bits for a pixel. Negative components become 0.
///
/// The file appears whole or not at all. limn writes a temporary file `.limn-*.tmp` in the same folder, flushes it to
/// disk, reads it back, compares it and renames it. A killed process may leave its temporary file; the next save in
/// that folder deletes it. A replaced file keeps its permissions, and its owner if the system permits that. Links are
/// followed, also to a file that does not exist yet. Only regular files are replaced, no pipes or devices.
///
/// \throws FileError that names the file, if
/// - its suffix is unknown,
/// - it cannot be written, or the disk is full,
/// - the image has no pixels,
/// - a value is not finite (PNG, HDR) or too large (HDR, half).
///
/// \throws ArgumentError if
/// - the name or the text of a fact is not allowed,
/// - the name of a layer is not allowed or occurs twice,
/// - alpha or a layer has not one value for each pixel,
/// - the picture is not inside the whole,
/// - the exposure of a PNG is not finite.
void save_image(const Image& image, const std::string& path, const SaveOptions& options = {});

/// Checks that save_image knows the suffix of the name. \throws FileError if it doesn't
void check_image_name(const std::string& path);

/// Returns true if save_image writes SaveOptions::layers to a file of that name: if it is an EXR.
/// \throws FileError if the suffix is unknown
bool image_holds_layers(const std::string& path);

/// Checks that a picture can be written to `path`: the suffix, the folder, permissions and free disk space. Writes a
/// temporary file in the folder and deletes it.
/// \throws FileError as save_image would
void check_writable(const std::string& path);

/// Reads the first three channels of a picture as linear values. If it has fewer than three, the first one is grey.
///
/// - Alpha is ignored: colours are not multiplied or divided by it.
/// - A CMYK JPEG is converted to RGB.
/// - The picture of an EXR is its data window.
///
/// limn checks the format and the header before any library decodes the file. It refuses a size for which the file is
/// too short or the machine's memory too small, before it allocates memory. JPEG, HDR, BMP and TGA have no checksums:
/// damage is not noticed if the file stays readable. Only regular files are read, no pipes or devices.
///
/// \throws FileError that names the file, if it is missing, truncated or too large, isn't a picture (the message says
/// what it appears to be), has a wrong checksum, or is an EXR with subsampled channels
Image load_image(const std::string& path, Encoding encoding = Encoding::automatic);

/// Reads a picture as load_image does, from the bytes of a file. Messages call it `name`.
Image load_image_from_memory(std::span<const std::byte> bytes, Encoding encoding = Encoding::automatic,
                             const std::string& name = "image in memory");

/// Reads the alpha channel of a picture, from 0 (transparent) to 1 (opaque), as stored. Red, green and blue of the
/// result are all alpha. Returns std::nullopt if the picture has no channel A; a JPEG or HDR never has one.
/// \throws FileError as load_image does
std::optional<Image> load_alpha(const std::string& path);

/// Reads an alpha channel as load_alpha does, from the bytes of a file. Messages call it `name`.
std::optional<Image> load_alpha_from_memory(std::span<const std::byte> bytes,
                                            const std::string& name = "image in memory");

/// One channel of a picture file.
struct ImageChannel {
    std::string name;  ///< "R", "G", "B", "A"; "Y" if there is only grey; others as the file names them
    std::string type;  ///< type of the stored values: "uint8", "uint16", "half", "float", ...
};

/// The header of a picture file.
struct ImageInfo {
    int width = 0;                       ///< width in pixels
    int height = 0;                      ///< height in pixels
    std::vector<ImageChannel> channels;  ///< all channels, in the order of the file
    std::optional<PartOf> part_of{};     ///< set for an EXR whose data window is not its display window
    /// SaveOptions::facts of a picture that save_image wrote, in no particular order.
    std::vector<std::pair<std::string, std::string>> facts{};
};

/// Reads the header of a picture. Pixels are not decoded.
/// \throws FileError as load_image does, except for faults that show only when pixels are decoded
ImageInfo load_image_info(const std::string& path);

/// Reads a header as load_image_info does, from the bytes of a file. Messages call it `name`.
ImageInfo load_image_info_from_memory(std::span<const std::byte> bytes, const std::string& name = "image in memory");

/// Reads the ImageInfo::facts of a picture. \throws FileError as load_image_info does
std::vector<std::pair<std::string, std::string>> load_image_facts(const std::string& path);

}  // namespace limn
