#pragma once

// WINSLOW_ADDRESS_SANITIZER: compiled for AddressSanitizer, which GCC and Clang say in two ways.
#if defined(__SANITIZE_ADDRESS__)
#define WINSLOW_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define WINSLOW_ADDRESS_SANITIZER
#endif
#endif
