// Images and buffers own memory, one view and a name; they can be moved. Host-visible buffers stay mapped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vulkan/device.h"

namespace drape::vulkan {

/// Returns the bytes of one texel; throws VulkanError for a format that Drape does not use.
std::uint32_t texel_size(VkFormat format);

struct ImageDescription {
    std::string name;
    VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    std::uint32_t width = 1, height = 1;
    VkImageUsageFlags usage = 0;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    /// The same memory is a storage buffer too, with texels row by row, `row_pitch` apart. Its tiling is LINEAR, so not
    /// every device has such images (Image::obstacle), and where one does a GPU may be slower through the image.
    bool buffer_view = false;
    /// Bands of equally many rows, from the top, have these names: each is an image with a buffer view of its own in
    /// this one's memory (Image::slices). They need a buffer view, since only LINEAR images may share memory. A band
    /// without a name is no image: some devices take .2 ms for each.
    std::vector<std::string> slices = {};
};

class Image {
  public:
    /// Throws VulkanError, before anything is created, when the size, format, usage or sample count is beyond the
    /// device, or the texels beyond the memory budget.
    Image(const Device& device, const ImageDescription& description);
    /// Returns why the device or its budget cannot have such an image; empty when they can. The row pitch of its buffer
    /// view must be `row_pitch`, where that is not 0.
    static std::string obstacle(const Device& device, const ImageDescription& description, std::uint32_t row_pitch = 0);
    ~Image();
    Image(Image&& other) noexcept;
    Image& operator=(Image&&) = delete;

    VkImage handle() const { return handle_; }
    VkImageView view() const { return view_; }
    VkImageAspectFlags aspect() const;
    const ImageDescription& description() const { return description_; }
    std::uint64_t byte_count() const { return byte_count_; }  ///< bytes allocated
    /// Return, for an image with a buffer view, the buffer and its texels from one row to the next.
    VkBuffer buffer() const { return buffer_; }
    std::uint32_t row_pitch() const { return row_pitch_; }
    /// Returns the images of ImageDescription::slices, which are made with this one and gone with it.
    const std::vector<Image>& slices() const { return slices_; }

  private:
    struct Empty {};
    /// Holds nothing yet: once it returned, a throw in the delegating constructor runs the destructor.
    Image(const Device& device, const ImageDescription& description, Empty);
    /// Makes image and buffer without memory; returns what both need of it.
    VkMemoryRequirements make_handles();
    void make_buffer(VkMemoryRequirements& requirements);
    VkDeviceSize slice_byte_count() const;
    /// Adds to what is needed of the memory.
    void make_slices(VkMemoryRequirements& requirements);
    void bind(VkDeviceMemory memory, VkDeviceSize offset);

    const Device* device_;
    ImageDescription description_;
    VkImage handle_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    std::uint32_t row_pitch_ = 0;
    std::uint64_t byte_count_ = 0;
    std::vector<Image> slices_;
    std::vector<VkDeviceSize> slice_offsets_;  ///< B
};

enum class BufferHome {
    device,    ///< device local
    upload,    ///< host writes, device reads; mapped, coherent
    readback,  ///< device writes, host reads; mapped, coherent, cached when there is such memory
};

struct BufferDescription {
    std::string name;
    std::uint64_t byte_count = 0;
    VkBufferUsageFlags usage = 0;
    BufferHome home = BufferHome::device;
};

class Buffer {
  public:
    /// Throws VulkanError, before anything is created, when the size is zero, beyond the device's limits (a storage
    /// buffer must be bindable whole) or beyond the memory budget.
    Buffer(const Device& device, const BufferDescription& description);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&&) = delete;

    VkBuffer handle() const { return handle_; }
    const BufferDescription& description() const { return description_; }
    /// Returns all of a buffer with the usage STORAGE_TEXEL_BUFFER as rgba32f texels. The default device loads these
    /// several times as fast as what is in a storage buffer (docs/devices.md).
    VkBufferView texels() const { return texels_; }
    /// Returns the mapped bytes; empty for BufferHome::device.
    std::span<std::byte> mapped() const { return {mapped_, mapped_ ? description_.byte_count : 0}; }

  private:
    struct Empty {};
    Buffer(const Device& device, const BufferDescription& description, Empty);
    void map();
    void make_texels();

    const Device* device_;
    BufferDescription description_;
    VkBuffer handle_ = VK_NULL_HANDLE;
    VkBufferView texels_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    std::byte* mapped_ = nullptr;
    std::uint64_t allocated_ = 0;
};

/// Set-up and tests transfer with these, each with its own submit and wait. Images are taken to (and left in) GENERAL;
/// `bytes` is tightly packed rows. An upload discards what the image held. The sizes must be equal, and the resource
/// made with the transfer usage (mapped buffers need none); VulkanError names it otherwise.
void upload(const Device& device, const Image& image, std::span<const std::byte> bytes);
void upload(const Device& device, const Buffer& buffer, std::span<const std::byte> bytes);
/// Uploads rows of an image from `first_row` on; the rest of its contents stays. It must be in GENERAL.
void upload_rows(const Device& device, const Image& image, std::uint32_t first_row, std::span<const std::byte> bytes);
/// Bytes of whole rows of an image.
struct RowsOfImage {
    const Image* image;
    std::uint32_t first_row;
    std::vector<std::byte> bytes;
};
/// Uploads all of them at once.
void upload_rows(const Device& device, std::span<const RowsOfImage> parts);
/// Uploads bytes of a buffer from `offset` on; the rest stays.
void upload_range(const Device& device, const Buffer& buffer, std::uint64_t offset, std::span<const std::byte> bytes);
void download(const Device& device, const Image& image, std::span<std::byte> bytes);
void download(const Device& device, const Buffer& buffer, std::span<std::byte> bytes);

}  // namespace drape::vulkan
