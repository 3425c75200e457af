/* The little of Vulkan that a compute shader needs: a device, buffers in memory shared with the
 * host, a program of SPIR-V, one dispatch at a time. The loader chooses the driver
 * (VK_ICD_FILENAMES). Errors print one line and end the process: exit code 77 if no device is
 * found, else 1. */
#ifndef TEST_SHADERS_VULKAN_H
#define TEST_SHADERS_VULKAN_H

#include <stddef.h>
#include <stdint.h>
#include <vulkan/vulkan.h>

enum { GPU_BUFFERS = 3, GPU_CONSTANTS = 64, GPU_GROUP = 64 };

typedef struct gpu_device {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkDevice device;
    VkQueue queue;
    VkCommandPool pool;
    VkCommandBuffer commands;
    VkFence fence;
    uint32_t family, memory_type;
    int has_half;                        /* float16 arithmetic */
    int keeps_denormals, has_round_even; /* of float32, what the driver promises */
    char name[256];                      /* device and driver */
    uint32_t largest_dispatch;           /* groups */
} gpu_device;

typedef struct gpu_buffer {
    VkBuffer buffer;
    VkDeviceMemory memory;
    void *data; /* mapped */
} gpu_buffer;

typedef struct gpu_program {
    VkShaderModule module;
    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkPipeline pipeline;
    VkDescriptorPool pool;
    VkDescriptorSet set;
} gpu_program;

/* The first device. */
void gpu_open(gpu_device *gpu);
void gpu_close(gpu_device *gpu);

void gpu_buffer_create(gpu_device *gpu, size_t size, gpu_buffer *buffer);
void gpu_buffer_destroy(gpu_device *gpu, gpu_buffer *buffer);

/* A compute shader from a file of SPIR-V, with storage buffers 0 .. GPU_BUFFERS - 1 of set 0, push
 * constants of GPU_CONSTANTS bytes and groups of GPU_GROUP. */
void gpu_program_create(gpu_device *gpu, const char *path, gpu_program *program);
void gpu_program_destroy(gpu_device *gpu, gpu_program *program);

/* Runs `count` invocations, rounded up to whole groups, and waits for them. buffers: GPU_BUFFERS,
 * any may repeat. */
void gpu_run(gpu_device *gpu, gpu_program *program, const gpu_buffer *const *buffers,
             const void *constants, size_t size, uint32_t count);

#endif
