// Odd and broken models, one file for each, and what load_obj makes of them: tests/io/data/obj/verdicts.txt.
#include <filesystem>
#include <iomanip>
#include <sstream>

#include "catch.h"
#include "limn/io/obj.h"
#include "limn/math/error.h"
#include "support/folder.h"

namespace limn::obj_corpus_test {

using namespace test;

namespace {

const std::string kCorpus = std::string(LIMN_TEST_DATA) + "/obj/";

struct Verdict {
    std::string file, text;  // the rest of the row
};

std::vector<Verdict> verdicts() {
    std::vector<Verdict> rows;
    std::ifstream table(kCorpus + "verdicts.txt");
    for (std::string line; std::getline(table, line);) {
        std::istringstream row(line);
        Verdict verdict;
        if (!(row >> verdict.file) || verdict.file == "#") continue;
        std::getline(row >> std::ws, verdict.text);
        rows.push_back(verdict);
    }
    return rows;
}

// The parts in quotes at the end of a row.
std::vector<std::string> quoted_parts(std::istream& row) {
    std::vector<std::string> parts;
    for (std::string part; row >> std::quoted(part, '"', '\v');) parts.push_back(part);
    return parts;
}

void check_loads(const Model& model, std::istream& expected) {
    std::size_t vertices = 0, faces = 0, triangles = 0, dropped = 0, degenerate = 0;
    REQUIRE(expected >> vertices >> faces >> triangles >> dropped >> degenerate);
    REQUIRE(model.meshes.size() == 1);
    const MeshData data = model.meshes[0]->data();
    CHECK(data.vertices.size() == vertices);
    CHECK(model.faces == faces);
    CHECK(data.triangles.size() == triangles);
    CHECK(model.dropped_faces == dropped);
    CHECK(model.degenerate_triangles == degenerate);
    const std::vector<std::string> warnings = quoted_parts(expected);
    CAPTURE(model.warnings);
    REQUIRE(model.warnings.size() == warnings.size());
    for (std::size_t i = 0; i < warnings.size(); ++i) CHECK(model.warnings[i].find(warnings[i]) != std::string::npos);
}

// The fault is in the file, or in the MTL of its name if there is one.
void check_refused(const std::string& path, const std::string& message, std::istream& expected) {
    std::size_t line = 0;
    REQUIRE(expected >> line);
    const std::string mtl = std::filesystem::path(path).replace_extension(".mtl").string();
    const std::string at_fault = std::filesystem::exists(mtl) ? mtl : path;
    CHECK(message.starts_with(at_fault + ": " + (line > 0 ? "line " + std::to_string(line) + ": " : "")));
    CHECK((line > 0) == (message.find(": line ") != std::string::npos));
    for (const std::string& part : quoted_parts(expected)) CHECK(message.find(part) != std::string::npos);
}

}  // namespace

TEST_CASE("OBJ corpus: every file is loaded or refused as its verdict says", "[io][obj]") {
    for (const Verdict& verdict : verdicts()) {
        CAPTURE(verdict.file, verdict.text);
        const std::string path = kCorpus + verdict.file;
        std::istringstream expected(verdict.text);
        std::string kind;
        expected >> kind;
        try {
            const Model model = load_obj(path);
            REQUIRE(kind == "loads");
            check_loads(model, expected);
        } catch (const FileError& error) {
            CAPTURE(std::string(error.what()));
            REQUIRE(kind == "refused");
            check_refused(path, error.what(), expected);
        }
    }
}

TEST_CASE("OBJ corpus: every model has one verdict", "[io][obj]") {
    std::multiset<std::string> judged, present;
    for (const Verdict& verdict : verdicts()) judged.insert(verdict.file);
    for (const auto& entry : std::filesystem::directory_iterator(kCorpus))
        if (entry.path().extension() == ".obj") present.insert(entry.path().filename());
    CHECK(judged == present);
    CHECK(judged.size() >= 70);
}

}  // namespace limn::obj_corpus_test
