#pragma once

/// The version of winslow: CMake, the program, packages and clients all read it here.
///
///     #include <winslow/winslow.h>
///     std::puts("mesh motion by winslow " WINSLOW_VERSION);
///     #if WINSLOW_VERSION_NUMBER < 100
///     #error "winslow 0.1 or later is needed"
///     #endif
///
/// While the first number is 0, a new interface increases the second number: find_package(winslow
/// 0.1) finds only 0.1.x. Repairs increase the third number.
#define WINSLOW_VERSION_MAJOR 0
#define WINSLOW_VERSION_MINOR 1
#define WINSLOW_VERSION_PATCH 0

/// One number to compare: 10000 MAJOR + 100 MINOR + PATCH.
#define WINSLOW_VERSION_NUMBER \
  (10000 * WINSLOW_VERSION_MAJOR + 100 * WINSLOW_VERSION_MINOR + WINSLOW_VERSION_PATCH)

#define WINSLOW_TEXT_OF(number) #number
#define WINSLOW_JOIN_VERSION(major, minor, patch) \
  WINSLOW_TEXT_OF(major) "." WINSLOW_TEXT_OF(minor) "." WINSLOW_TEXT_OF(patch)
/// As text: "0.1.0".
#define WINSLOW_VERSION \
  WINSLOW_JOIN_VERSION(WINSLOW_VERSION_MAJOR, WINSLOW_VERSION_MINOR, WINSLOW_VERSION_PATCH)
