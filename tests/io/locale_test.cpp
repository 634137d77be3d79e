// A program may run in a locale with decimal commas, of C++ and of C: OpenImageIO and others read numbers with sscanf.
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <locale>

#include "catch.h"
#include "formats.h"
#include "io/text_lines.h"
#include "limn/io/image_io.h"
#include "limn/io/obj.h"
#include "make_png.h"
#include "support/folder.h"

namespace limn::locale_test {

using namespace test;

namespace {

// Both kinds of locale at once, the C one built on the spot: few machines have any but English.
class CommaLocale {
public:
    CommaLocale() {
        struct Commas : std::numpunct<char> {
            char do_decimal_point() const override { return ','; }
            char do_thousands_sep() const override { return '.'; }
            std::string do_grouping() const override { return "\3"; }
        };
        before_ = std::locale::global(std::locale(std::locale(), new Commas));
        folder_.write("source",
                      "LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\ngrouping 3;3\nEND LC_NUMERIC\n"
                      "LC_CTYPE\ncopy \"POSIX\"\nEND LC_CTYPE\n");
        const std::string build = "localedef -c --no-archive -i " + folder_.path("source") + " -f ANSI_X3.4-1968 " +
                                  folder_.path("comma") + " >/dev/null 2>&1";
        if (std::system(build.c_str()) < 0) return;  // it ends with 1 for its warnings
        setenv("LOCPATH", folder_.path().c_str(), 1);
        std::setlocale(LC_NUMERIC, "comma");
    }
    ~CommaLocale() {
        std::setlocale(LC_NUMERIC, "C");
        unsetenv("LOCPATH");
        std::locale::global(before_);
    }
    CommaLocale(const CommaLocale&) = delete;
    CommaLocale& operator=(const CommaLocale&) = delete;

    bool is_in_c() const { return std::strtod("1,5", nullptr) == 1.5; }

private:
    Folder folder_;
    std::locale before_;
};

}  // namespace

TEST_CASE("Locale: a decimal comma changes nothing in what is read and written", "[io][obj][image]") {
    const Folder folder;
    folder.write("a.mtl", "newmtl m\nKd 0.5 0.25 1234.5\nNs 1000.5\n");
    const std::string obj = folder.write(
        "a.obj", "mtllib a.mtl\nv 0.5 -1234567.25 1e-1\nv 1 0 0\nv 0 1 0\nvn 0 0.5 0.5\nusemtl m\nf 1//1 2//1 3//1\n");
    const std::string png = make_png(1, 8, PngColor::rgb, "\x80\x80\x80", test::png_chunk("gAMA", big_endian(45455)));
    const std::string hdr =
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nGAMMA=1.5\nEXPOSURE=0.25\n\n-Y 1 +X 1\n\x80\x40\xc0\x80";
    const auto everything = [&] {
        std::string text;
        const MeshData mesh = load_obj(obj).meshes[0]->data();
        for (const Float3& v : mesh.vertices)
            for (const float x : {v.x, v.y, v.z}) append_number(text += ' ', x);
        for (const std::string& stored : {folder.write("gamma.png", png), folder.write("gamma.hdr", hdr)})
            append_number(text += ' ', load_image(stored).values()[0]);
        for (const std::string& suffix : written_suffixes()) {
            save_image(noise(5, 4, 1), folder.path("a" + suffix), {.facts = {{"seconds", "1234.5"}}});
            text += folder.read("a" + suffix) + load_image_facts(folder.path("a" + suffix)).at(0).second;
        }
        return text;
    };
    const std::string plain = everything();
    std::string with_commas;
    bool is_in_c = false;
    {
        const CommaLocale commas;
        is_in_c = commas.is_in_c();
        with_commas = everything();
    }
    if (!is_in_c) WARN("no localedef here: the C library kept its decimal point");
    CHECK(with_commas == plain);
}

TEST_CASE("Locale: the one that the tests build takes commas in C and in C++", "[io]") {
    const CommaLocale commas;
    std::istringstream stream("1,5");
    stream.imbue(std::locale());
    double value = 0;
    stream >> value;
    CHECK(value == 1.5);
    if (!commas.is_in_c()) return;
    char text[16];
    std::snprintf(text, sizeof text, "%g", 0.25);
    CHECK(std::string(text) == "0,25");
}

}  // namespace limn::locale_test
