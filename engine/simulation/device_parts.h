#pragma once

#include <memory>
#include <string>

#include "drape/device.h"
#include "vulkan/device.h"
#include "vulkan/instance.h"

namespace drape {

struct Device::Parts {
    Parts(const std::string& selector, Validation validation)
        : instance({.validation = validation != Validation::off, .print_messages = validation == Validation::print}),
          device(instance, selector) {}
    vulkan::Instance instance;
    vulkan::Device device;
    std::unique_ptr<Parts> drawing;  ///< the device that draws the pictures; null: this one does
};

}  // namespace drape
