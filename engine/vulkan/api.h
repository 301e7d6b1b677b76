// Vulkan's functions come by volk. Everything that calls Vulkan includes this, nothing includes volk or Vulkan's
// headers. No result code can be ignored: what a function returns must be looked at, or the file does not compile (a
// cast to void does not help). `check` (error.h) throws what is no success.
#pragma once

#ifdef VULKAN_CORE_H_
#error "include vulkan/api.h instead of Vulkan's own headers"
#endif

#define VK_NO_PROTOTYPES
// Vulkan has this place for an attribute of all its function types.
#include <vulkan/vk_platform.h>
#undef VKAPI_PTR
#define VKAPI_PTR __attribute__((warn_unused_result))
#include <volk.h>

#pragma GCC diagnostic error "-Wunused-result"
