#include "vulkan/texel_storage.h"

#include <spirv_cross/spirv.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <set>

namespace drape::vulkan {

namespace {

using Words = std::span<const std::uint32_t>;
using Id = std::uint32_t;

constexpr std::size_t header_words = 5, bound_word = 3;

class TexelRewriter {
  public:
    explicit TexelRewriter(Words module) : module_(module), next_(module[bound_word]) {
        for_each([this](SpvOp op, Words words) { find(op, words); });
    }

    bool has_texels() const { return !images_.empty(); }

    std::vector<std::uint32_t> rewritten() {
        out_.assign(module_.begin(), module_.begin() + header_words);
        for (const Id image : images_) arrays_[image] = next_++;
        if (vector_pointer_ == 0) made_pointer_ = vector_pointer_ = next_++;
        zero_ = next_++;
        for_each([this](SpvOp op, Words words) { rewrite(op, words); });
        out_[bound_word] = next_;
        return std::move(out_);
    }

  private:
    template <class Function>
    void for_each(const Function& function) const {
        for (std::size_t at = header_words; at < module_.size();) {
            const std::size_t count = module_[at] >> SpvWordCountShift;
            function(static_cast<SpvOp>(module_[at] & SpvOpCodeMask), module_.subspan(at, count));
            at += count;
        }
    }

    void find(SpvOp op, Words words) {
        if (op == SpvOpTypeFloat && words[2] == 32) float_ = words[1];
        if (op == SpvOpTypeVector && words[2] == float_ && words[3] == 4) vector_ = words[1];
        if (op == SpvOpTypeInt && words[2] == 32) integer_ = words[1];
        if (op == SpvOpTypeImage && words[3] == SpvDimBuffer) images_.insert(words[1]);
        if (op == SpvOpTypePointer) {
            if (images_.contains(words[3])) pointers_[words[1]] = words[3];
            if (words[2] == SpvStorageClassStorageBuffer && words[3] == vector_) vector_pointer_ = words[1];
        }
        if (op == SpvOpVariable && pointers_.contains(words[1])) variables_[words[2]] = words[1];
        if (op == SpvOpDecorate || op == SpvOpMemberDecorate) last_decoration_ = words.data();
        if (op == SpvOpLoad && images_.contains(words[1])) loads_[words[2]] = words[3];
    }

    void emit(SpvOp op, std::initializer_list<std::uint32_t> operands) {
        out_.push_back(static_cast<std::uint32_t>(operands.size() + 1) << SpvWordCountShift | op);
        out_.insert(out_.end(), operands);
    }

    void rewrite(SpvOp op, Words words) {
        const bool moved = (op == SpvOpTypeImage && images_.contains(words[1])) ||
                           (op == SpvOpTypePointer && pointers_.contains(words[1])) ||
                           (op == SpvOpVariable && variables_.contains(words[2])) ||
                           (op == SpvOpLoad && images_.contains(words[1]));
        if (moved) return;
        if (op == SpvOpFunction && !declared_) declare();
        if (op == SpvOpImageRead && loads_.contains(words[3])) {
            const Id place = next_++;
            emit(SpvOpAccessChain, {vector_pointer_, place, loads_.at(words[3]), zero_, words[4]});
            emit(SpvOpLoad, {words[1], words[2], place});
            return;
        }
        out_.insert(out_.end(), words.begin(), words.end());
        if (words.data() == last_decoration_) decorate();
    }

    void decorate() {
        for (const auto& [image, array] : arrays_) {
            emit(SpvOpDecorate, {array, SpvDecorationArrayStride, 16});
            emit(SpvOpDecorate, {image, SpvDecorationBlock});
            emit(SpvOpMemberDecorate, {image, 0, SpvDecorationOffset, 0});
        }
    }

    /// All types that these need are declared by then, and no other needs these.
    void declare() {
        declared_ = true;
        for (const auto& [image, array] : arrays_) {
            emit(SpvOpTypeRuntimeArray, {array, vector_});
            emit(SpvOpTypeStruct, {image, array});
        }
        for (const auto& [pointer, image] : pointers_)
            emit(SpvOpTypePointer, {pointer, SpvStorageClassStorageBuffer, image});
        if (made_pointer_ != 0) emit(SpvOpTypePointer, {made_pointer_, SpvStorageClassStorageBuffer, vector_});
        emit(SpvOpConstant, {integer_, zero_, 0});
        for (const auto& [variable, pointer] : variables_)
            emit(SpvOpVariable, {pointer, variable, SpvStorageClassStorageBuffer});
    }

    Words module_;
    Id next_;
    Id float_ = 0, vector_ = 0, integer_ = 0, vector_pointer_ = 0, made_pointer_ = 0, zero_ = 0;
    std::set<Id> images_;
    std::map<Id, Id> arrays_, pointers_, variables_, loads_;  ///< of an image, to one, of a pointer, from a variable
    const std::uint32_t* last_decoration_ = nullptr;
    bool declared_ = false;
    std::vector<std::uint32_t> out_;
};

}  // namespace

std::vector<std::uint32_t> texels_as_storage(Words module) {
    TexelRewriter rewriter(module);
    if (!rewriter.has_texels()) return {module.begin(), module.end()};
    return rewriter.rewritten();
}

}  // namespace drape::vulkan
