# One static library per folder of src/, and what all of them share.

# A project that adds this one links what its layers link.
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(glm REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Boost REQUIRED)
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
# Debian ships a float and a float64 Bullet side by side; this is the float one.
pkg_check_modules(BULLET REQUIRED IMPORTED_TARGET GLOBAL bullet)

find_library(XXHASH_LIBRARY xxhash REQUIRED)
find_library(TINYGLTF_LIBRARY tinygltf REQUIRED)
find_package(tomlplusplus QUIET)

# For our own code only, and errors only where we build it ourselves; what stands in ringcraft_flags is for whoever includes our headers, too:
# the linker keeps one copy of an inline function, and that may be the user's.
add_compile_options(-Wall -Wextra -Wconversion -Wno-sign-conversion)
if(PROJECT_IS_TOP_LEVEL)
  add_compile_options(-Werror)
endif()
add_library(ringcraft_flags INTERFACE)
target_include_directories(ringcraft_flags INTERFACE ${PROJECT_SOURCE_DIR}/src)
target_compile_features(ringcraft_flags INTERFACE cxx_std_20)
# Same inputs, same bytes: no contraction of a*b+c, never -ffast-math. Nobody asks for errno
# or floating-point traps: a square root is one instruction then, and a loop may do four at once.
target_compile_options(ringcraft_flags INTERFACE
  -ffp-contract=off -fno-math-errno -fno-trapping-math)
# Eight floats at once in place of four, each as it was: no fused multiply-add comes with it.
if(RINGCRAFT_AVX2)
  target_compile_options(ringcraft_flags INTERFACE -mavx2)
endif()
target_compile_definitions(ringcraft_flags INTERFACE
  RINGCRAFT_SOURCE_ASSETS="${PROJECT_SOURCE_DIR}/assets" RINGCRAFT_VERSION="${PROJECT_VERSION}")
if(RINGCRAFT_SANITIZE)
  # GCC's own notice: -fsanitize makes -Wmaybe-uninitialized see what is not there (std::regex).
  target_compile_options(ringcraft_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer
    -fno-sanitize-recover=undefined -Wno-maybe-uninitialized)
  target_link_options(ringcraft_flags INTERFACE -fsanitize=address,undefined)
endif()
if(RINGCRAFT_FUZZ)
  # Warnings are GCC's business; clang is here for its fuzzer.
  target_compile_options(ringcraft_flags INTERFACE -fsanitize=address,undefined,fuzzer-no-link
    -fno-omit-frame-pointer -fno-sanitize-recover=undefined -Wno-error)
  target_link_options(ringcraft_flags INTERFACE -fsanitize=address,undefined)
endif()

# What a layer links from outside, besides the layers below it.
set(ringcraft_base_packages fmt::fmt spdlog::spdlog glm::glm nlohmann_json::nlohmann_json
    Threads::Threads ${XXHASH_LIBRARY})
set(ringcraft_motion_packages Eigen3::Eigen Boost::headers)
set(ringcraft_capture_packages ${TINYGLTF_LIBRARY})
set(ringcraft_physics_packages PkgConfig::BULLET Eigen3::Eigen)
set(ringcraft_io_packages ${TINYGLTF_LIBRARY})

# ringcraft_layer(NAME BELOW...): the static library ringcraft_NAME from src/NAME.
function(ringcraft_layer name)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.h)
  if(NOT sources)
    add_library(ringcraft_${name} INTERFACE)
    set(access INTERFACE)
  else()
    add_library(ringcraft_${name} STATIC ${sources})
    set(access PUBLIC)
    # Every public header compiles alone (target all_verify_interface_header_sets).
    target_sources(ringcraft_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src
      FILES ${headers})
    set_target_properties(ringcraft_${name} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
  endif()
  target_link_libraries(ringcraft_${name} ${access} ringcraft_flags ${ringcraft_${name}_packages})
  foreach(below IN LISTS ARGN)
    target_link_libraries(ringcraft_${name} ${access} ringcraft_${below})
  endforeach()
endfunction()

# The command `ringcraft` from src/cli: the library ringcraft_cli, and its main.
function(ringcraft_command)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/cli/*.cpp)
  list(REMOVE_ITEM sources ${PROJECT_SOURCE_DIR}/src/cli/main.cpp)
  add_library(ringcraft_cli STATIC ${sources})
  target_link_libraries(ringcraft_cli PUBLIC ringcraft_scene ringcraft_capture)
  add_executable(ringcraft ${PROJECT_SOURCE_DIR}/src/cli/main.cpp)
  target_link_libraries(ringcraft PRIVATE ringcraft_cli)
endfunction()
