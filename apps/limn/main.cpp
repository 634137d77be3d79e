#include "commands.h"

int main(int argc, char** argv) { return limn::app::run_limn(argc, argv); }
