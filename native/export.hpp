// What Python may call: SHIPCOLLISION_EXPORT before a function named shipcollision_*. The functions of FMI have their
// own word for it, from FMI's headers.
#pragma once

#ifdef _WIN32
#define SHIPCOLLISION_EXPORT extern "C" __declspec(dllexport)
#else
#define SHIPCOLLISION_EXPORT extern "C" __attribute__((visibility("default")))
#endif
