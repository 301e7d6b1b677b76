// Tests of the library's public interface share this device, opened as its users open one.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>

#include "drape/simulation.h"

namespace drape::test {

/// Ends the device when the tests have run: what validation layers keep for main()'s thread ends before static
/// variables do, and newer ones are not called after that.
class LibraryDevice : public testing::Environment {
  public:
    const Device& opened() {
        if (!device_) device_.emplace("", Validation::count);
        return *device_;
    }
    void TearDown() override { device_.reset(); }

  private:
    std::optional<Device> device_;
};
inline auto* const library_environment =
    static_cast<LibraryDevice*>(testing::AddGlobalTestEnvironment(new LibraryDevice));

/// Validated; the one that main() chose.
inline const Device& library_device() { return library_environment->opened(); }

/// Any message of the validation layer fails the test.
class LibraryTest : public testing::Test {
  protected:
    void TearDown() override { EXPECT_EQ(library_device().validation_count(), before_); }

  private:
    std::uint64_t before_ = library_device().validation_count();
};

}  // namespace drape::test
