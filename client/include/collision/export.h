// What the shared library shows.
#pragma once

/// Before a class or function: programs that link the library may use it. All else is hidden.
#define COLLISION_API __attribute__((visibility("default")))

/// Before a part of such a class: it stays hidden.
#define COLLISION_HIDDEN __attribute__((visibility("hidden")))
