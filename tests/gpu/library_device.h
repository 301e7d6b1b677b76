// Tests of the library's public interface share this device, opened as its users open one.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include "drape/simulation.h"

namespace drape::test {

/// Validated; the one that main() chose.
inline const Device& library_device() {
    static const Device opened("", Validation::count);
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
