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
    /// The same memory is also a storage buffer, with texels row by row, `row_pitch` apart. The tiling is LINEAR, so
    /// not every device has such images (Image::obstacle), and where one does, a GPU may access the image more slowly.
    bool buffer_view = false;
    /// The names of bands of equally many rows, from the top: each is an image of its own with a buffer view, in this
    /// image's memory (Image::slices). They need `buffer_view`, since only LINEAR images may share memory. A band
    /// without a name gets no image: some devices take .2 ms to create each.
    std::vector<std::string> slices = {};
};

class Image {
  public:
    /// Throws VulkanError, before anything is created, when size, format, usage or sample count exceeds what the device
    /// allows, or the texels exceed the memory budget.
    Image(const Device& device, const ImageDescription& description);
    /// Returns why the device or its budget does not allow such an image; empty when they do. If `row_pitch` is not 0,
    /// the buffer view must have this row pitch.
    static std::string obstacle(const Device& device, const ImageDescription& description, std::uint32_t row_pitch = 0);
    ~Image();
    Image(Image&& other) noexcept;
    Image& operator=(Image&&) = delete;

    VkImage handle() const { return handle_; }
    VkImageView view() const { return view_; }
    VkImageAspectFlags aspect() const;
    const ImageDescription& description() const { return description_; }
    std::uint64_t byte_count() const { return byte_count_; }  ///< bytes allocated
    /// Return the buffer of an image with a buffer view, and its texels from one row to the next.
    VkBuffer buffer() const { return buffer_; }
    std::uint32_t row_pitch() const { return row_pitch_; }
    /// Returns the images of ImageDescription::slices, which live as long as this one.
    const std::vector<Image>& slices() const { return slices_; }

  private:
    struct Empty {};
    /// Makes an object without handles. After this constructor, an exception in the delegating one runs the destructor.
    Image(const Device& device, const ImageDescription& description, Empty);
    /// Makes image and buffer without memory; returns the memory requirements of both.
    VkMemoryRequirements make_handles();
    void make_buffer(VkMemoryRequirements& requirements);
    VkDeviceSize slice_byte_count() const;
    /// Adds the slices' memory requirements.
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
    std::vector<VkDeviceSize> slice_offsets_;  ///< bytes
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
    /// Throws VulkanError, before anything is created, when the size is zero, exceeds the device's limits (a storage
    /// buffer must be bindable as a whole) or exceeds the memory budget.
    Buffer(const Device& device, const BufferDescription& description);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&&) = delete;

    VkBuffer handle() const { return handle_; }
    const BufferDescription& description() const { return description_; }
    /// Returns a view of all of a buffer with the usage STORAGE_TEXEL_BUFFER, as rgba32f texels. The default device
    /// loads these several times as fast as the elements of a storage buffer (docs/devices.md).
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

/// Transfers for set-up and tests, each with its own submit and wait. Images are brought to GENERAL and left there;
/// `bytes` is tightly packed rows. An upload discards what the image held. The sizes must be equal, and the resource
/// must have the transfer usage (mapped buffers need none); otherwise a VulkanError names it.
void upload(const Device& device, const Image& image, std::span<const std::byte> bytes);
void upload(const Device& device, const Buffer& buffer, std::span<const std::byte> bytes);
/// Uploads rows of an image from `first_row` on; its other contents stay. The image must be in GENERAL.
void upload_rows(const Device& device, const Image& image, std::uint32_t first_row, std::span<const std::byte> bytes);
/// Bytes of whole rows of an image.
struct RowsOfImage {
    const Image* image;
    std::uint32_t first_row;
    std::vector<std::byte> bytes;
};
/// Uploads all these parts at once.
void upload_rows(const Device& device, std::span<const RowsOfImage> parts);
/// Uploads bytes of a buffer from `offset` on; its other contents stay.
void upload_range(const Device& device, const Buffer& buffer, std::uint64_t offset, std::span<const std::byte> bytes);
void download(const Device& device, const Image& image, std::span<std::byte> bytes);
void download(const Device& device, const Buffer& buffer, std::span<std::byte> bytes);

}  // namespace drape::vulkan
