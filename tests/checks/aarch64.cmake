# limn::core and its tests for AArch64, with Debian's cross compiler and packages; tests run in qemu's user mode.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
# Highway 1.0.3 builds its NEON code with this extension; g++ does not inline that into functions without.
set(CMAKE_CXX_FLAGS_INIT -march=armv8-a+crypto)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64)
