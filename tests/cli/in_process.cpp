// bin/limn's commands as functions.
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "commands.h"
#include "process.h"

namespace limn::test {

Outcome limn(const Words& arguments, const std::string& folder) {
    std::vector<const char*> argv = {"limn"};
    for (const std::string& word : arguments) argv.push_back(word.c_str());
    const Folder streams;
    const std::filesystem::path here = std::filesystem::current_path();

    // Descriptor 1 stays as it is: there Catch2 says which case has crashed. glibc lets a program replace its stdout.
    std::FILE* const out_before = stdout;
    stdout = std::fopen(streams.path("out").c_str(), "w");
    const int err_before = dup(STDERR_FILENO);
    std::FILE* const err = std::fopen(streams.path("err").c_str(), "w");
    dup2(fileno(err), STDERR_FILENO);
    std::filesystem::current_path(folder);

    Outcome outcome;
    outcome.status = app::run_limn(static_cast<int>(argv.size()), argv.data());

    std::filesystem::current_path(here);
    dup2(err_before, STDERR_FILENO);
    close(err_before);
    std::fclose(err);
    std::fclose(stdout);
    stdout = out_before;
    outcome.out = streams.read("out");
    outcome.err = streams.read("err");
    return outcome;
}

}  // namespace limn::test
