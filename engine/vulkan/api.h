// volk loads Vulkan's functions. Every file that calls Vulkan includes this header; none includes volk's or Vulkan's
// own. No result code can be ignored: a file that does not use the value of such a function does not compile (a cast to
// void does not help). `check` (error.h) throws for a result that is no success.
#pragma once

#ifdef VULKAN_CORE_H_
#error "include vulkan/api.h instead of Vulkan's own headers"
#endif

#define VK_NO_PROTOTYPES
// Vulkan's headers provide this macro for an attribute on all its function types.
#include <vulkan/vk_platform.h>
#undef VKAPI_PTR
#define VKAPI_PTR __attribute__((warn_unused_result))
#include <volk.h>

#pragma GCC diagnostic error "-Wunused-result"
