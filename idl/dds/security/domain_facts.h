/* What Cyclone DDS knows of its domain and shows to nobody: its headers of that are for C alone. */
#pragma once

#include <stddef.h>

struct ddsi_sertype;

#ifdef __cplusplus
extern "C" {
#endif

/** The name of the first network interface that leads off this machine, or NULL. `type` is that of
 * a reader or writer; the name lives as long as its domain. */
const char* CollisionOpenInterface(const struct ddsi_sertype* type);

/** 1: the network profile, and not a program, secures its domain; else 0. */
int CollisionProfileSecures(const struct ddsi_sertype* type);

#ifdef __cplusplus
}
#endif
