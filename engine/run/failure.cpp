#include "run/failure.h"

#include <fmt/format.h>

#include <new>

#include "base/output_error.h"
#include "base/printable_text.h"
#include "run/run.h"
#include "vulkan/instance.h"

namespace drape {

namespace {

std::string vulkan_hint(const vulkan::VulkanError& error) {
    if (error.result() != VK_ERROR_INCOMPATIBLE_DRIVER) return {};
    return "\n  A driver that runs on any CPU is in Debian's package mesa-vulkan-drivers; VK_ICD_FILENAMES, "
           "if set, "
           "must name existing driver files.";
}

}  // namespace

Failure current_failure() {
    try {
        throw;
    } catch (const SceneFailure& failure) {
        return {failure.result().unreadable ? ExitCode::io : ExitCode::scene, failure.what(), true};
    } catch (const UsageError& error) {
        return {ExitCode::usage, printable(error.what())};
    } catch (const OutputError& error) {
        return {ExitCode::io, printable(error.what())};
    } catch (const Diverged& error) {
        return {ExitCode::diverged, error.what()};
    } catch (const ToleranceMissed& error) {
        return {ExitCode::tolerance, error.what()};
    } catch (const vulkan::VulkanError& error) {
        return {ExitCode::device, error.what() + vulkan_hint(error)};
    } catch (const std::bad_alloc&) {
        return {ExitCode::device, "out of memory"};
    } catch (const std::exception& error) {
        return {ExitCode::internal, fmt::format("internal error: {}", error.what())};
    }
}

}  // namespace drape
