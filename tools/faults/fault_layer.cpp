// A Vulkan layer, VK_LAYER_DRAPE_faults, that makes calls fail. It stands above the validation layer, which then tells
// what is left over. Its environment:
//   DRAPE_FAULT=ENTRY_POINT:N:RESULT[:on]   the N-th call (from 1) of that entry point is not made, returns RESULT
//                                           (a number), and leaves garbage for a handle; `on`: later ones too
//   DRAPE_FAULT_LOG=FILE                    gets a line `ENTRY_POINT COUNT` per entry point that was called, when the
//                                           process ends, and a line `fault` when a call was failed
#include <dlfcn.h>
#include <link.h>
#include <vulkan/vk_layer.h>

#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "entry_points.h"

namespace {

enum EntryPoint : std::size_t {
#define DRAPE_ENUMERATE(name) name##_index,
    DRAPE_ENTRY_POINTS(DRAPE_ENUMERATE)
#undef DRAPE_ENUMERATE
        entry_point_count
};

constexpr std::array<const char*, entry_point_count> names{
#define DRAPE_NAME(name) #name,
    DRAPE_ENTRY_POINTS(DRAPE_NAME)
#undef DRAPE_NAME
};

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

struct Fault {
    std::string name;
    unsigned long first = 0;
    VkResult result = VK_SUCCESS;
    bool on = false;
};

/// A wish that is not understood ends the process: a test that fails nothing would prove nothing.
Fault wanted_fault() {
    const std::string text = environment("DRAPE_FAULT");
    if (text.empty()) return {};
    Fault fault;
    const std::size_t number = text.find(':'), result = text.find(':', number + 1);
    bool understood = number != text.npos && result != text.npos;
    if (understood) {
        fault.name = text.substr(0, number);
        fault.first = std::strtoul(text.c_str() + number + 1, nullptr, 10);
        char* end = nullptr;
        fault.result = static_cast<VkResult>(std::strtol(text.c_str() + result + 1, &end, 10));
        fault.on = std::string_view(end) == ":on";
        bool known = false;
        for (const char* name : names) known = known || fault.name == name;
        understood = known && fault.first > 0 && (*end == 0 || fault.on);
    }
    if (understood) return fault;
    std::fprintf(stderr, "VK_LAYER_DRAPE_faults: DRAPE_FAULT=%s is not understood\n", text.c_str());
    std::_Exit(99);
}

/// Counts the calls of this process, and fails the wanted ones.
class Faults {
  public:
    ~Faults() {
        const std::string log = environment("DRAPE_FAULT_LOG");
        std::FILE* file = log.empty() ? nullptr : std::fopen(log.c_str(), "w");
        if (!file) return;
        for (std::size_t k = 0; k < entry_point_count; ++k)
            if (counts_[k] > 0) std::fprintf(file, "%s %lu\n", names[k], counts_[k].load());
        if (happened_) std::fprintf(file, "fault\n");
        std::fclose(file);
    }
    std::optional<VkResult> next(std::size_t entry_point) {
        const unsigned long number = ++counts_[entry_point];
        if (fault_.name != names[entry_point]) return std::nullopt;
        if (number < fault_.first || (number > fault_.first && !fault_.on)) return std::nullopt;
        happened_ = true;
        return fault_.result;
    }

  private:
    Fault fault_ = wanted_fault();
    std::array<std::atomic<unsigned long>, entry_point_count> counts_{};
    std::atomic<bool> happened_ = false;
};
Faults faults;

/// The next layer's functions, by the pointer that the loader puts first into each dispatchable object. They are looked
/// up when it is created: later the loader may answer with the first layer's, and the chain would be a ring.
struct Next {
    PFN_vkGetInstanceProcAddr instance_function = nullptr;
    PFN_vkGetDeviceProcAddr device_function = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::array<PFN_vkVoidFunction, entry_point_count> functions{};

    PFN_vkVoidFunction find(const char* name) const {
        return device ? device_function(device, name) : instance_function(instance, name);
    }
    void look_up() {
        for (std::size_t k = 0; k < entry_point_count; ++k) functions[k] = find(names[k]);
    }
};
std::mutex nexts_mutex;
std::map<void*, Next> nexts;

template <class Handle>
void* key_of(Handle handle) {
    return *reinterpret_cast<void**>(handle);
}

template <class Handle>
Next next_of(Handle handle) {
    const std::lock_guard lock(nexts_mutex);
    return nexts[key_of(handle)];
}

template <class Handle>
void keep(Handle handle, const Next& next) {
    const std::lock_guard lock(nexts_mutex);
    nexts[key_of(handle)] = next;
}

/// Leaves garbage where a function returns a handle through its last argument.
template <class Last>
void leave_garbage(Last last) {
    if constexpr (std::is_pointer_v<Last>) {
        using Target = std::remove_pointer_t<Last>;
        if constexpr (std::is_pointer_v<Target> && !std::is_const_v<Target>)
            if (last) *last = std::bit_cast<Target>(std::uintptr_t{0xdead});
    }
}

template <std::size_t entry_point, class Function>
struct Intercepted;

template <std::size_t entry_point, class First, class... Rest>
struct Intercepted<entry_point, VkResult(VKAPI_PTR*)(First, Rest...)> {
    static VKAPI_ATTR VkResult VKAPI_CALL call(First first, Rest... rest) {
        if (const std::optional<VkResult> result = faults.next(entry_point)) {
            const std::tuple<First, Rest...> all(first, rest...);
            // VK_TIMEOUT and the like are successes, whose outputs are valid.
            if (*result < 0) leave_garbage(std::get<sizeof...(Rest)>(all));
            return *result;
        }
        using Function = VkResult(VKAPI_PTR*)(First, Rest...);
        return reinterpret_cast<Function>(next_of(first).functions[entry_point])(first, rest...);
    }
};

/// Returns the chain element that names the next layer, moved on by one.
template <class Link, class Create>
Link* link_of(const Create* info, VkStructureType type) {
    for (auto* link = static_cast<const Link*>(info->pNext); link; link = static_cast<const Link*>(link->pNext))
        if (link->sType == type && link->function == VK_LAYER_LINK_INFO) return const_cast<Link*>(link);
    return nullptr;
}

/// The loader unloads a driver with its last instance. Memory that the driver keeps for the life of the process, which
/// is reachable only from its own data, would then look like a leak of this program to a sanitizer.
void keep_libraries_loaded() {
    const auto pin = [](dl_phdr_info* library, std::size_t, void*) {
        if (*library->dlpi_name) dlopen(library->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
        return 0;
    };
    dl_iterate_phdr(pin, nullptr);
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                               VkInstance* instance) {
    if (const auto result = faults.next(vkCreateInstance_index)) return leave_garbage(instance), *result;
    auto* link = link_of<VkLayerInstanceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    Next next{link->u.pLayerInfo->pfnNextGetInstanceProcAddr};
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(next.find("vkCreateInstance"));
    const VkResult result = create(info, allocator, instance);
    keep_libraries_loaded();
    if (result != VK_SUCCESS) return result;
    next.instance = *instance;
    next.look_up();
    keep(*instance, next);
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator, VkDevice* device) {
    if (const auto result = faults.next(vkCreateDevice_index)) return leave_garbage(device), *result;
    auto* link = link_of<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    Next next{nullptr, link->u.pLayerInfo->pfnNextGetDeviceProcAddr};
    const auto instance_function = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create =
        reinterpret_cast<PFN_vkCreateDevice>(instance_function(next_of(physical).instance, "vkCreateDevice"));
    const VkResult result = create(physical, info, allocator, device);
    if (result != VK_SUCCESS) return result;
    next.device = *device;
    next.look_up();
    keep(*device, next);
    return VK_SUCCESS;
}

PFN_vkVoidFunction intercepted(std::string_view name) {
    if (name == "vkCreateInstance") return reinterpret_cast<PFN_vkVoidFunction>(create_instance);
    if (name == "vkCreateDevice") return reinterpret_cast<PFN_vkVoidFunction>(create_device);
#define DRAPE_INTERCEPT(entry)                                                                      \
    if constexpr (entry##_index != vkCreateInstance_index && entry##_index != vkCreateDevice_index) \
        if (name == #entry) return reinterpret_cast<PFN_vkVoidFunction>(Intercepted<entry##_index, PFN_##entry>::call);
    DRAPE_ENTRY_POINTS(DRAPE_INTERCEPT)
#undef DRAPE_INTERCEPT
    return nullptr;
}

}  // namespace

// Newer headers of Vulkan have no VK_LAYER_EXPORT.
#define DRAPE_EXPORT __attribute__((visibility("default")))

extern "C" {

DRAPE_EXPORT VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetDeviceProcAddr(VkDevice device, const char* name) {
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(vkGetDeviceProcAddr);
    const PFN_vkVoidFunction next = next_of(device).find(name);
    const PFN_vkVoidFunction own = next ? intercepted(name) : nullptr;
    return own ? own : next;
}

DRAPE_EXPORT VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance, const char* name) {
    if (std::strcmp(name, "vkGetInstanceProcAddr") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(vkGetInstanceProcAddr);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(vkGetDeviceProcAddr);
    if (std::strcmp(name, "vkCreateInstance") == 0) return intercepted(name);
    if (!instance) return nullptr;
    const PFN_vkVoidFunction next = next_of(instance).find(name);
    const PFN_vkVoidFunction own = next ? intercepted(name) : nullptr;
    return own ? own : next;
}

DRAPE_EXPORT VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* versions) {
    versions->loaderLayerInterfaceVersion = 2;
    versions->pfnGetInstanceProcAddr = vkGetInstanceProcAddr;
    versions->pfnGetDeviceProcAddr = vkGetDeviceProcAddr;
    versions->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
}
