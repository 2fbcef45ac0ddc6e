// What the shared library shows.
#pragma once

#if __cplusplus < 202002L
#error "these headers need C++20: -std=c++20; collision/collision.h serves C and older C++"
#endif

/// Before a class or function: programs that link the library may use it. All else is hidden.
#define COLLISION_API __attribute__((visibility("default")))

/// Before a part of such a class: it stays hidden.
#define COLLISION_HIDDEN __attribute__((visibility("hidden")))
