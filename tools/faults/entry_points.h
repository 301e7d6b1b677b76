// Entry points that return a VkResult and that a layer is asked for: those of Vulkan 1.0 to 1.3 on instances, devices,
// queues and command buffers, and the debug messenger's. No explicit layer sees those that the loader answers itself
// (layers, extensions and the version of an instance).
#pragma once

// clang-format off
#define DRAPE_ENTRY_POINTS(X) \
    X(vkCreateInstance) X(vkEnumeratePhysicalDevices) X(vkGetPhysicalDeviceImageFormatProperties) X(vkCreateDevice) \
    X(vkEnumerateDeviceExtensionProperties) X(vkQueueSubmit) X(vkQueueWaitIdle) X(vkDeviceWaitIdle) X(vkAllocateMemory) \
    X(vkMapMemory) X(vkFlushMappedMemoryRanges) X(vkInvalidateMappedMemoryRanges) X(vkBindBufferMemory) \
    X(vkBindImageMemory) X(vkQueueBindSparse) X(vkCreateFence) X(vkResetFences) X(vkGetFenceStatus) X(vkWaitForFences) \
    X(vkCreateSemaphore) X(vkCreateEvent) X(vkGetEventStatus) X(vkSetEvent) X(vkResetEvent) X(vkCreateQueryPool) \
    X(vkGetQueryPoolResults) X(vkCreateBuffer) X(vkCreateBufferView) X(vkCreateImage) X(vkCreateImageView) \
    X(vkCreateShaderModule) X(vkCreatePipelineCache) X(vkGetPipelineCacheData) X(vkMergePipelineCaches) \
    X(vkCreateGraphicsPipelines) X(vkCreateComputePipelines) X(vkCreatePipelineLayout) X(vkCreateSampler) \
    X(vkCreateDescriptorSetLayout) X(vkCreateDescriptorPool) X(vkResetDescriptorPool) X(vkAllocateDescriptorSets) \
    X(vkFreeDescriptorSets) X(vkCreateFramebuffer) X(vkCreateRenderPass) X(vkCreateCommandPool) X(vkResetCommandPool) \
    X(vkAllocateCommandBuffers) X(vkBeginCommandBuffer) X(vkEndCommandBuffer) X(vkResetCommandBuffer) \
    X(vkBindBufferMemory2) X(vkBindImageMemory2) X(vkEnumeratePhysicalDeviceGroups) \
    X(vkGetPhysicalDeviceImageFormatProperties2) X(vkCreateSamplerYcbcrConversion) X(vkCreateDescriptorUpdateTemplate) \
    X(vkCreateRenderPass2) X(vkGetSemaphoreCounterValue) X(vkWaitSemaphores) X(vkSignalSemaphore) \
    X(vkGetPhysicalDeviceToolProperties) X(vkCreatePrivateDataSlot) X(vkSetPrivateData) X(vkQueueSubmit2) \
    X(vkCreateDebugUtilsMessengerEXT) X(vkSetDebugUtilsObjectNameEXT)
// clang-format on
