// Tests of the library's public interface share this device, opened as its users open one.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>

#include "drape/simulation.h"

namespace drape::test {

/// The device is validated. The environment variable DRAPE_TEST_DEVICE selects it as --device does.
inline const Device& library_device() {
    const char* selector = std::getenv("DRAPE_TEST_DEVICE");
    static const Device opened(selector ? selector : "", Validation::count);
    return opened;
}

/// Any message of the validation layer fails the test.
class LibraryTest : public testing::Test {
  protected:
    void TearDown() override { EXPECT_EQ(library_device().validation_count(), before_); }

  private:
    std::uint64_t before_ = library_device().validation_count();
};

}  // namespace drape::test
