#include "vulkan/specialisation.h"

#include <fmt/format.h>
#include <spirv_cross/spirv.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <set>

namespace drape::vulkan {

namespace {

using Words = std::span<const std::uint32_t>;
using Id = std::uint32_t;
using ConstantValues = std::map<std::uint32_t, std::uint32_t>;  // by the number of `constant_id`

ConstantValues values_in(const ReflectedModule& module, std::span<const SpecializationConstant> constants) {
    ConstantValues values;
    for (const SpecializationConstant& constant : constants)
        if (const auto found = module.constants.find(constant.name); found != module.constants.end())
            values[found->second] = constant.value;
    return values;
}

/// An instruction; its first word has length and opcode.
struct Instruction {
    Words words;

    SpvOp op() const { return static_cast<SpvOp>(words[0] & SpvOpCodeMask); }
    Id type() const { return has().second ? words[1] : 0; }
    Id result() const { return !has().first ? 0 : words[has().second ? 2 : 1]; }

  private:
    std::pair<bool, bool> has() const {
        bool result = false, type = false;
        SpvHasResultAndType(op(), &result, &type);
        return {result, type};
    }
};

/// A basic block: its label first, its terminator last.
struct Block {
    std::span<const Instruction> instructions;
    bool is_live = false;
    /// The header of a loop whose continue target a dead block is; 0: none.
    Id continues = 0;
    bool is_merged_to = false;  ///< by a live header

    Id label() const { return instructions.front().words[1]; }
    const Instruction& end() const { return instructions.back(); }
    /// Returns the merge instruction; null where the block is no header.
    const Instruction* merge() const {
        if (instructions.size() < 2) return nullptr;
        const Instruction& before = instructions[instructions.size() - 2];
        return before.op() == SpvOpSelectionMerge || before.op() == SpvOpLoopMerge ? &before : nullptr;
    }
};

struct Function {
    std::span<const Instruction> head;  ///< OpFunction and its parameters
    std::vector<Block> blocks;
    bool is_called = false;
};

std::optional<std::uint32_t> evaluated(SpvOp op, std::uint32_t a, std::uint32_t b) {
    const auto x = static_cast<std::int32_t>(a), y = static_cast<std::int32_t>(b);
    switch (op) {
        case SpvOpIAdd:
            return a + b;
        case SpvOpISub:
            return a - b;
        case SpvOpIMul:
            return a * b;
        case SpvOpSDiv:
            return y == 0 || y == -1 ? std::nullopt : std::optional(static_cast<std::uint32_t>(x / y));
        case SpvOpShiftRightArithmetic:
            return static_cast<std::uint32_t>(x >> (b & 31u));
        case SpvOpBitwiseAnd:
            return a & b;
        case SpvOpBitwiseOr:
            return a | b;
        case SpvOpLogicalAnd:
            return a && b;
        case SpvOpLogicalOr:
            return a || b;
        case SpvOpLogicalNot:
            return !a;
        case SpvOpIEqual:
        case SpvOpLogicalEqual:
            return a == b;
        case SpvOpINotEqual:
        case SpvOpLogicalNotEqual:
            return a != b;
        case SpvOpSLessThan:
            return x < y;
        case SpvOpSLessThanEqual:
            return x <= y;
        case SpvOpSGreaterThan:
            return x > y;
        case SpvOpSGreaterThanEqual:
            return x >= y;
        default:
            return std::nullopt;
    }
}

/// What is known of an id.
struct About {
    std::optional<std::uint32_t> value{};  ///< of 32 bits, or of truth
    Words parts{};                         ///< of a composite constant
    bool is_defined = false;               ///< in what was written
    bool is_variable_in_use = false;
    bool is_type_in_use = false;
};

class Specialiser {
  public:
    Specialiser(Words words, const ConstantValues& values) : header_(words.first(header_size)), values_(values) {
        for (Words rest = words.subspan(header_size); !rest.empty(); rest = rest.subspan(rest[0] >> SpvWordCountShift))
            all_.push_back({rest.first(rest[0] >> SpvWordCountShift)});
        ids_.resize(words[3]);
        const auto first = std::ranges::find(all_, SpvOpFunction, &Instruction::op);
        globals_ = std::span(all_).first(static_cast<std::size_t>(first - all_.begin()));
        find_functions(std::span(all_).subspan(globals_.size()));
    }

    std::vector<std::uint32_t> words() {
        find_constants();
        for (std::size_t k = 0; k < called_.size(); ++k) find_live(functions_.at(called_[k]));  // which finds more
        std::vector<std::uint32_t> bodies;
        for (auto& [id, function] : functions_)
            if (function.is_called) emit(function, bodies);
        find_optional_types();
        std::vector<std::uint32_t> declarations, head(header_.begin(), header_.end());
        for (const Instruction& each : globals_)
            if (!is_about_module(each)) emit_declaration(each, declarations);
        for (const Instruction& each : globals_)
            if (is_about_module(each)) emit_about_module(each, head);
        head.insert(head.end(), declarations.begin(), declarations.end());
        head.insert(head.end(), bodies.begin(), bodies.end());
        return head;
    }

  private:
    static constexpr std::size_t header_size = 5;

    void find_functions(std::span<const Instruction> rest) {
        for (std::size_t k = 0; k < rest.size();) {
            const std::size_t first = k;
            while (rest[k].op() != SpvOpLabel) ++k;
            Function& function = functions_[rest[first].result()];
            function.head = rest.subspan(first, k - first);
            while (rest[k].op() != SpvOpFunctionEnd) {
                const std::size_t label = k;
                while (k == label || (rest[k].op() != SpvOpLabel && rest[k].op() != SpvOpFunctionEnd)) ++k;
                block_of_[rest[label].result()] = {&function, function.blocks.size()};
                function.blocks.push_back({rest.subspan(label, k - label)});
            }
            ++k;
        }
    }

    void find_constants() {
        std::map<Id, std::uint32_t> numbers;
        for (const Instruction& each : globals_) {
            const Words words = each.words;
            if (each.op() == SpvOpEntryPoint) call(words[2]);
            if (each.op() == SpvOpDecorate && words[2] == SpvDecorationSpecId) numbers[words[1]] = words[3];
            if (each.op() == SpvOpTypeBool) bool_ = words[1];
            if (each.op() == SpvOpConstantTrue || each.op() == SpvOpSpecConstantTrue) ids_[words[2]].value = 1;
            if (each.op() == SpvOpConstantFalse || each.op() == SpvOpSpecConstantFalse) ids_[words[2]].value = 0;
            if ((each.op() == SpvOpConstant || each.op() == SpvOpSpecConstant) && words.size() == 4)
                ids_[words[2]].value = words[3];
            if (const auto number = numbers.find(each.result()); number != numbers.end())
                if (const auto value = values_.find(number->second); value != values_.end())
                    ids_[each.result()].value = value->second;
            if (each.op() == SpvOpConstantComposite || each.op() == SpvOpSpecConstantComposite)
                ids_[words[2]].parts = words.subspan(3);
            if (each.op() == SpvOpSpecConstantOp)
                ids_[words[2]].value = value_of(static_cast<SpvOp>(words[3]), words.subspan(4));
        }
    }

    std::optional<std::uint32_t> value_of(SpvOp op, Words operands) const {
        if (op == SpvOpCompositeExtract) {
            const Words parts = ids_[operands[0]].parts;
            return !parts.empty() && operands.size() == 2 ? ids_[parts[operands[1]]].value : std::nullopt;
        }
        if (op == SpvOpSelect)
            return ids_[operands[0]].value ? ids_[operands[*ids_[operands[0]].value ? 1 : 2]].value : std::nullopt;
        const std::optional<std::uint32_t> a = ids_[operands[0]].value,
                                           b = operands.size() > 1 ? ids_[operands[1]].value : a;
        // One operand may be enough.
        if (op == SpvOpLogicalAnd && (a == 0u || b == 0u)) return 0;
        if (op == SpvOpLogicalOr && (a == 1u || b == 1u)) return 1;
        return a && b ? evaluated(op, *a, *b) : std::nullopt;
    }

    void call(Id function) {
        if (functions_.at(function).is_called) return;
        functions_.at(function).is_called = true;
        called_.push_back(function);
    }

    Block& block(Id label) {
        const auto& [function, place] = block_of_.at(label);
        return function->blocks[place];
    }

    /// Returns whether a block can go on to one block alone, for its condition is known. One that may go back to a
    /// loop's header has to, or the loop would be none.
    bool is_decided(const Block& from) const {
        const Words words = from.end().words;
        if (from.end().op() != SpvOpBranchConditional || !ids_[words[1]].value) return false;
        const auto& [function, other] = block_of_.at(words[*ids_[words[1]].value ? 3 : 2]);
        const Instruction* merge = function->blocks[other].merge();
        return !merge || merge->op() != SpvOpLoopMerge || other > block_of_.at(from.label()).second;
    }

    /// Returns the blocks to which a live one may go on.
    std::vector<Id> successors(const Block& from) const {
        const Words words = from.end().words;
        switch (from.end().op()) {
            case SpvOpBranch:
                return {words[1]};
            case SpvOpBranchConditional:
                if (is_decided(from)) return {words[*ids_[words[1]].value ? 2 : 3]};
                return {words[2], words[3]};
            case SpvOpSwitch: {
                std::vector<Id> all;  // the selector has 32 bits
                for (std::size_t k = 2; k < words.size(); k += 2) all.push_back(words[k]);
                return all;
            }
            default:
                return {};
        }
    }

    void find_live(Function& function) {
        std::vector<Id> pending{function.blocks.front().label()};
        while (!pending.empty()) {
            Block& next = block(pending.back());
            pending.pop_back();
            if (next.is_live) continue;
            next.is_live = true;
            for (const Instruction& each : next.instructions) {
                if (each.op() == SpvOpFunctionCall) call(each.words[3]);
                if (evaluates(each)) ids_[each.result()].value = value_of(each.op(), each.words.subspan(3));
            }
            for (const Id each : successors(next)) pending.push_back(each);
        }
        for (const Block& each : function.blocks) {
            const Instruction* merge = each.merge();
            if (!each.is_live || !merge || is_straight(each)) continue;
            block(merge->words[1]).is_merged_to = true;
            if (merge->op() == SpvOpLoopMerge) block(merge->words[2]).continues = each.label();
        }
    }

    static bool evaluates(const Instruction& each) {
        return each.type() != 0 && each.words.size() > 3 && each.words.size() < 6 &&
               (each.op() == SpvOpLogicalAnd || each.op() == SpvOpLogicalOr || each.op() == SpvOpLogicalNot ||
                each.op() == SpvOpSLessThan || each.op() == SpvOpSGreaterThan || each.op() == SpvOpIEqual ||
                each.op() == SpvOpSLessThanEqual || each.op() == SpvOpSGreaterThanEqual || each.op() == SpvOpINotEqual);
    }

    /// Returns whether a header is none any more, for its condition is known. One of a loop stays.
    bool is_straight(const Block& each) const {
        return is_decided(each) && each.merge() && each.merge()->op() == SpvOpSelectionMerge;
    }

    static void add(std::vector<std::uint32_t>& to, SpvOp op, std::initializer_list<std::uint32_t> operands) {
        to.push_back(static_cast<std::uint32_t>(operands.size() + 1) << SpvWordCountShift | op);
        to.insert(to.end(), operands);
    }

    void copy(const Instruction& each, std::vector<std::uint32_t>& to) {
        if (each.result() != 0) ids_[each.result()].is_defined = true;
        if (each.type() != 0) ids_[each.type()].is_type_in_use = true;
        to.insert(to.end(), each.words.begin(), each.words.end());
    }

    void emit(Function& function, std::vector<std::uint32_t>& to) {
        for (const Instruction& each : function.head) copy(each, to);
        for (const Block& each : function.blocks) {
            if (each.is_live)
                emit_live(each, to);
            else if (each.continues != 0 || each.is_merged_to)
                emit_dead(each, to);
        }
        add(to, SpvOpFunctionEnd, {});
    }

    void emit_live(const Block& from, std::vector<std::uint32_t>& to) {
        for (const Instruction& each : from.instructions) {
            mark_variables(each);
            if (each.op() == SpvOpPhi)
                emit_phi(from, each, to);
            else if (&each == &from.end() && is_decided(from))
                add(to, SpvOpBranch, {successors(from)[0]});
            else if (&each != from.merge() || !is_straight(from))
                copy(each, to);
        }
    }

    /// Nobody comes to a block that is dead, but a live header names it.
    void emit_dead(const Block& from, std::vector<std::uint32_t>& to) {
        copy(from.instructions.front(), to);
        if (from.continues == 0) return add(to, SpvOpUnreachable, {});
        for (const Instruction& phi : block(from.continues).instructions)
            for (std::size_t k = 3; phi.op() == SpvOpPhi && k < phi.words.size(); k += 2)
                if (comes_from_dead(from.continues, phi.words[k + 1]) && is_in_function(phi.words[k])) {
                    add(to, SpvOpUndef, {phi.type(), phi.words[k]});
                    ids_[phi.words[k]].is_defined = true;
                }
        add(to, SpvOpBranch, {from.continues});
    }

    /// Returns whether an id is of a function, and not yet written.
    bool is_in_function(Id id) const {
        return !ids_[id].is_defined && std::ranges::find(globals_, id, &Instruction::result) == globals_.end();
    }

    bool comes_from_dead(Id to, Id from) {
        const std::vector<Id> next = block(from).is_live ? successors(block(from)) : std::vector<Id>();
        return std::ranges::find(next, to) == next.end();
    }

    void emit_phi(const Block& at, const Instruction& phi, std::vector<std::uint32_t>& to) {
        const std::size_t first = to.size();
        add(to, SpvOpPhi, {phi.words[1], phi.words[2]});
        ids_[phi.result()].is_defined = true;
        ids_[phi.type()].is_type_in_use = true;
        const Instruction* merge = at.merge();
        const bool is_loop = merge && merge->op() == SpvOpLoopMerge;
        for (std::size_t k = 3; k < phi.words.size(); k += 2) {
            const bool is_dead = comes_from_dead(at.label(), phi.words[k + 1]);
            if (is_dead && !(is_loop && !block(merge->words[2]).is_live)) continue;
            to.insert(to.end(), {phi.words[k], is_dead ? merge->words[2] : phi.words[k + 1]});
            to[first] += 2u << SpvWordCountShift;
        }
    }

    /// Marks the ids that an instruction may take as variables.
    void mark_variables(const Instruction& each) {
        const Words words = each.words;
        const auto use = [&](std::size_t k) { ids_[words[k]].is_variable_in_use = true; };
        const SpvOp op = each.op();
        const bool is_atomic = op >= SpvOpAtomicLoad && op <= SpvOpAtomicXor;
        if (op == SpvOpStore || op == SpvOpCopyMemory || op == SpvOpAtomicStore) use(1);
        if (op == SpvOpCopyMemory) use(2);
        if (op == SpvOpLoad || op == SpvOpAccessChain || op == SpvOpInBoundsAccessChain ||
            op == SpvOpImageTexelPointer || op == SpvOpArrayLength || op == SpvOpCopyObject ||
            (is_atomic && op != SpvOpAtomicStore))
            use(3);
        for (std::size_t k = 4; op == SpvOpFunctionCall && k < words.size(); ++k) use(k);
    }

    static bool is_about_module(const Instruction& each) {
        switch (each.op()) {
            case SpvOpCapability:
            case SpvOpExtension:
            case SpvOpExtInstImport:
            case SpvOpMemoryModel:
            case SpvOpEntryPoint:
            case SpvOpExecutionMode:
            case SpvOpExecutionModeId:
            case SpvOpString:
            case SpvOpSource:
            case SpvOpSourceExtension:
            case SpvOpName:
            case SpvOpMemberName:
            case SpvOpDecorate:
            case SpvOpMemberDecorate:
                return true;
            default:
                return false;
        }
    }

    /// Outputs stay, and so do push constants, which must be as C++ has them.
    bool is_left_out(const Instruction& variable) const {
        return variable.op() == SpvOpVariable && !ids_[variable.result()].is_variable_in_use &&
               variable.words[3] != SpvStorageClassOutput && variable.words[3] != SpvStorageClassPushConstant;
    }

    /// Finds the types that not every device has, and whether any of them is still used.
    void find_optional_types() {
        for (OptionalTypes* const group : {&wide_, &multisampled_}) {
            const auto is_in_group = [&](Id id) { return group->types.contains(id); };
            for (const Instruction& each : globals_) {
                const Words words = each.words;
                const SpvOp op = each.op();
                const bool is_list = op == SpvOpTypeVector || op == SpvOpTypeArray || op == SpvOpTypeRuntimeArray;
                if ((group == &wide_ ? op == SpvOpTypeInt && words[2] == 64
                                     : op == SpvOpTypeImage && words[6] == 1 && words[7] == 2) ||
                    (is_list && is_in_group(words[2])) || (op == SpvOpTypePointer && is_in_group(words[3])) ||
                    ((op == SpvOpTypeStruct || op == SpvOpTypeFunction) &&
                     std::ranges::any_of(words.subspan(2), is_in_group)))
                    group->types.insert(words[1]);
            }
            group->needed = std::ranges::any_of(group->types, [&](Id type) { return bool{ids_[type].is_type_in_use}; });
        }
    }

    void emit_declaration(const Instruction& each, std::vector<std::uint32_t>& to) {
        const auto is_needless = [&](const OptionalTypes& group) {
            return !group.needed && (group.types.contains(each.type()) || group.types.contains(each.result()));
        };
        if (is_left_out(each) || is_needless(wide_) || is_needless(multisampled_)) return;
        const std::optional<std::uint32_t> value = each.result() != 0 ? ids_[each.result()].value : std::nullopt;
        if (value) {
            ids_[each.result()].is_defined = true;
            if (each.type() == bool_)
                add(to, *value ? SpvOpConstantTrue : SpvOpConstantFalse, {each.type(), each.result()});
            else
                add(to, SpvOpConstant, {each.type(), each.result(), *value});
            return;
        }
        const std::size_t first = to.size();
        copy(each, to);
        const auto is_known = [&](Id id) { return ids_[id].value.has_value(); };
        if (each.op() == SpvOpSpecConstantComposite && std::ranges::all_of(each.words.subspan(3), is_known))
            to[first] = (to[first] & ~std::uint32_t{SpvOpCodeMask}) | SpvOpConstantComposite;
    }

    void emit_about_module(const Instruction& each, std::vector<std::uint32_t>& to) {
        const Words words = each.words;
        switch (each.op()) {
            case SpvOpCapability:
                if (!wide_.needed && (words[1] == SpvCapabilityInt64 || words[1] == SpvCapabilityInt64Atomics)) return;
                if (multisampled_.needed || words[1] != SpvCapabilityStorageImageMultisample) copy(each, to);
                return;
            case SpvOpEntryPoint: {
                const char* name = reinterpret_cast<const char*>(&words[3]);
                const std::size_t first = to.size(), interface = 3 + std::strlen(name) / sizeof(std::uint32_t) + 1;
                to.insert(to.end(), words.begin(), words.begin() + static_cast<std::ptrdiff_t>(interface));
                std::ranges::copy_if(words.subspan(interface), std::back_inserter(to),
                                     [&](Id variable) { return ids_[variable].is_defined; });
                to[first] = static_cast<std::uint32_t>(to.size() - first) << SpvWordCountShift | SpvOpEntryPoint;
                return;
            }
            case SpvOpName:
            case SpvOpMemberName:
            case SpvOpDecorate:
            case SpvOpMemberDecorate:
                if (ids_[words[1]].is_defined && !(each.op() == SpvOpDecorate && words[2] == SpvDecorationSpecId))
                    copy(each, to);
                return;
            default:
                copy(each, to);
        }
    }

    Words header_;
    const ConstantValues& values_;
    std::vector<Instruction> all_;
    std::span<const Instruction> globals_;
    std::map<Id, Function> functions_;
    std::map<Id, std::pair<Function*, std::size_t>> block_of_;
    std::vector<Id> called_;
    Id bool_ = 0;
    std::vector<About> ids_;  ///< by id
    /// Types that only a capability allows, which a device may lack where no code is left that needs them.
    struct OptionalTypes {
        std::set<Id> types = {};
        bool needed = false;
    } wide_, multisampled_;  ///< of 64-bit integers, of storage images with samples
};

}  // namespace

SpecialisedModule specialise(std::span<const std::uint32_t> words, const std::string& module,
                             std::span<const SpecializationConstant> constants) {
    const ConstantValues values = values_in(reflect(words, module), constants);
    SpecialisedModule result{Specialiser(words, values).words(), {}};
    result.reflected = reflect(result.words, module);
    return result;
}

const SpecialisedModule& specialised_module(const std::string& module,
                                            std::span<const SpecializationConstant> constants) {
    static std::mutex guard;
    static std::map<std::pair<std::string, ConstantValues>, SpecialisedModule> modules;
    const ConstantValues values = values_in(module_interface(module), constants);
    const std::scoped_lock lock(guard);
    const auto [found, is_new] = modules.try_emplace({module, values});
    if (is_new) {
        found->second.words = Specialiser(spirv_module(module), values).words();
        found->second.reflected = reflect(found->second.words, module);
    }
    return found->second;
}

}  // namespace drape::vulkan
