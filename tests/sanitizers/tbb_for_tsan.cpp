// Tells the thread sanitizer what TBB orders. TBB's library is not instrumented: without this a task would seem to race
// with all that was done before it was spawned, and the reports of true races would have to go with the false ones.
// The preset `tsan` links this in front of TBB and does not instrument it.
#include <tbb/cache_aligned_allocator.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>

#include <cstdlib>
#include <new>

#include <dlfcn.h>
#include <sanitizer/tsan_interface.h>

namespace tbb::detail::r1 {

namespace {

/// The function of TBB's library that one of this file stands in front of.
template <class Function>
Function* behind(const char* symbol) {
    void* found = dlsym(RTLD_NEXT, symbol);
    if (!found) std::abort();
    return reinterpret_cast<Function*>(found);
}

/// A task that takes place after all that its spawner had done.
class OrderedTask final : public d1::task {
public:
    explicit OrderedTask(d1::task& spawned) : spawned_(&spawned) { __tsan_release(spawned_); }

    d1::task* execute(d1::execution_data& data) override { return taken().execute(data); }

    d1::task* cancel(d1::execution_data& data) override { return taken().cancel(data); }

private:
    d1::task& taken() {
        d1::task* const spawned = spawned_;
        __tsan_acquire(spawned);
        delete this;
        return *spawned;
    }

    d1::task* spawned_;
};

/// What stands in for the filter that this thread runs.
thread_local d1::base_filter* standIn = nullptr; // NOLINT: TBB asks for it by a free function

/// A filter that takes place after what made its item, and after itself if it is serial; the pipeline ends after it.
class OrderedFilter final : public d1::base_filter {
public:
    OrderedFilter(d1::base_filter& inner, d1::task_group_context& pipeline)
        : base_filter(modeOf(inner)), inner_(&inner), pipeline_(&pipeline) {}

    ~OrderedFilter() override {
        __tsan_acquire(pipeline_); // whatever thread ran it last
        inner_->~base_filter();
        deallocate_memory(inner_);
    }

    void* operator()(void* item) override {
        if (item) __tsan_acquire(item);
        if (is_serial()) __tsan_acquire(this);
        standIn = this;
        void* const made = (*inner_)(item);
        if (made) __tsan_release(made);
        if (is_serial()) __tsan_release(this);
        __tsan_release(pipeline_);
        return made;
    }

    void finalize(void* item) override {
        __tsan_acquire(item);
        inner_->finalize(item);
    }

private:
    static unsigned modeOf(d1::base_filter& filter) {
        return (filter.is_serial() ? filter_is_serial : 0) |
               (filter.is_serial() && !filter.is_ordered() ? filter_is_out_of_order : 0) |
               (filter.object_may_be_null() ? filter_may_emit_null : 0);
    }

    d1::base_filter* inner_;
    d1::task_group_context* pipeline_;
};

/// The nodes of a pipeline, with ordered filters.
class OrderedNode final : public d1::filter_node {
public:
    OrderedNode(const d1::filter_node& inner, d1::task_group_context& pipeline) : inner_(&inner), pipeline_(&pipeline) {
        if (inner.left) left = ordered(*inner.left, pipeline);
        if (inner.right) right = ordered(*inner.right, pipeline);
    }

    d1::base_filter* create_filter() const override {
        return new (allocate_memory(sizeof(OrderedFilter))) OrderedFilter(*inner_->create_filter(), *pipeline_);
    }

    static d1::filter_node* ordered(const d1::filter_node& inner, d1::task_group_context& pipeline) {
        return new (allocate_memory(sizeof(OrderedNode))) OrderedNode(inner, pipeline);
    }

private:
    const d1::filter_node* inner_;
    d1::task_group_context* pipeline_;
};

/// Takes what the tasks released that counted `waited` down. The count lies behind one word.
void acquire(d1::wait_context& waited) {
    __tsan_acquire(reinterpret_cast<std::uint64_t*>(&waited) + 1);
}

/// Memory that is given back after it was taken, whatever thread of TBB does that.
void* fresh(std::size_t bytes) {
    void* const memory = ::operator new (bytes, std::align_val_t{64});
    __tsan_release(memory);
    return memory;
}

void discard(void* memory) {
    __tsan_acquire(memory);
    ::operator delete (memory, std::align_val_t{64});
}

void* fresh(d1::small_object_pool*& pool, std::size_t bytes) {
    static std::uint64_t place;
    pool = reinterpret_cast<d1::small_object_pool*>(&place); // must not be null, and is handed back
    return fresh(bytes);
}

} // namespace

void spawn(d1::task& task, d1::task_group_context& context) {
    static const auto next = behind<void(d1::task&, d1::task_group_context&)>(
        "_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextE");
    next(*new OrderedTask(task), context);
}

void spawn(d1::task& task, d1::task_group_context& context, d1::slot_id slot) {
    static const auto next = behind<void(d1::task&, d1::task_group_context&, d1::slot_id)>(
        "_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextEt");
    next(*new OrderedTask(task), context, slot);
}

void execute_and_wait(
    d1::task& task, d1::task_group_context& context, d1::wait_context& waited, d1::task_group_context& waiting) {
    static const auto next =
        behind<void(d1::task&, d1::task_group_context&, d1::wait_context&, d1::task_group_context&)>(
            "_ZN3tbb6detail2r116execute_and_waitERNS0_2d14taskERNS2_18task_group_contextERNS2_12wait_contextES6_");
    next(task, context, waited, waiting);
    acquire(waited);
}

void wait(d1::wait_context& waited, d1::task_group_context& context) {
    static const auto next = behind<void(d1::wait_context&, d1::task_group_context&)>(
        "_ZN3tbb6detail2r14waitERNS0_2d112wait_contextERNS2_18task_group_contextE");
    next(waited, context);
    acquire(waited);
}

void parallel_pipeline(d1::task_group_context& context, std::size_t tokens, const d1::filter_node& node) {
    static const auto next = behind<void(d1::task_group_context&, std::size_t, const d1::filter_node&)>(
        "_ZN3tbb6detail2r117parallel_pipelineERNS0_2d118task_group_contextEmRKNS2_11filter_nodeE");
    const d1::filter_node_ptr ordered(OrderedNode::ordered(node, context));
    next(context, tokens, *ordered);
    __tsan_acquire(&context);
}

// The filter that calls it does not know what stands in for it, and the pipeline knows nothing else.
void set_end_of_input(d1::base_filter&) {
    static const auto next =
        behind<void(d1::base_filter&)>("_ZN3tbb6detail2r116set_end_of_inputERNS0_2d111base_filterE");
    next(*standIn);
}

// The sanitizer forgets who used a piece of memory when it is given back, so what TBB allocates comes from its heap.
void* allocate(d1::small_object_pool*& pool, std::size_t bytes, const d1::execution_data&) {
    return fresh(pool, bytes);
}

void* allocate(d1::small_object_pool*& pool, std::size_t bytes) {
    return fresh(pool, bytes);
}

void deallocate(d1::small_object_pool&, void* object, std::size_t, const d1::execution_data&) {
    discard(object);
}

void deallocate(d1::small_object_pool&, void* object, std::size_t) {
    discard(object);
}

void* allocate_memory(std::size_t bytes) {
    return fresh(bytes);
}

void deallocate_memory(void* memory) {
    discard(memory);
}

void* cache_aligned_allocate(std::size_t bytes) {
    return fresh(bytes);
}

void cache_aligned_deallocate(void* memory) {
    discard(memory);
}

} // namespace tbb::detail::r1
