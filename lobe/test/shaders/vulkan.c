#include "vulkan.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void need(VkResult result, const char *what) {
    if (result != VK_SUCCESS) {
        printf("gpu: %s: VkResult %d\n", what, (int)result);
        exit(1);
    }
}

static void choose_device(gpu_device *gpu) {
    uint32_t count = 1;
    VkResult result = vkEnumeratePhysicalDevices(gpu->instance, &count, &gpu->physical);
    if ((result != VK_SUCCESS && result != VK_INCOMPLETE) || count == 0) {
        printf("gpu: no Vulkan device; run scripts/install-deps shaders\n");
        exit(77);
    }
}

/* A queue that computes. */
static void choose_family(gpu_device *gpu) {
    VkQueueFamilyProperties families[16];
    uint32_t count = 16;
    vkGetPhysicalDeviceQueueFamilyProperties(gpu->physical, &count, families);
    for (gpu->family = 0; gpu->family < count; ++gpu->family) {
        if (families[gpu->family].queueFlags & VK_QUEUE_COMPUTE_BIT) {
            return;
        }
    }
    need(VK_ERROR_FEATURE_NOT_PRESENT, "a queue that computes");
}

/* Memory shared with the host, cached if possible: results are read from it. */
static void choose_memory(gpu_device *gpu) {
    const VkMemoryPropertyFlags shared =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(gpu->physical, &memory);
    gpu->memory_type = UINT32_MAX;
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags flags = memory.memoryTypes[i].propertyFlags;
        if ((flags & shared) == shared &&
            (gpu->memory_type == UINT32_MAX || (flags & VK_MEMORY_PROPERTY_HOST_CACHED_BIT))) {
            gpu->memory_type = i;
        }
    }
}

static void describe(gpu_device *gpu) {
    VkPhysicalDeviceVulkan12Properties driver = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES};
    VkPhysicalDeviceProperties2 properties = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &driver};
    VkPhysicalDeviceVulkan12Features half = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceFeatures2 features = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                          .pNext = &half};
    vkGetPhysicalDeviceProperties2(gpu->physical, &properties);
    vkGetPhysicalDeviceFeatures2(gpu->physical, &features);
    gpu->has_half = half.shaderFloat16 != 0;
    gpu->keeps_denormals = driver.shaderDenormPreserveFloat32 != 0;
    gpu->has_round_even = driver.shaderRoundingModeRTEFloat32 != 0;
    gpu->largest_dispatch = properties.properties.limits.maxComputeWorkGroupCount[0];
    snprintf(gpu->name, sizeof gpu->name, "%.120s (%.60s %.60s)", properties.properties.deviceName,
             driver.driverName, driver.driverInfo);
}

static void create_device(gpu_device *gpu) {
    const float priority = 1;
    VkPhysicalDeviceVulkan12Features half = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
        .shaderFloat16 = (VkBool32)gpu->has_half};
    const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                           .queueFamilyIndex = gpu->family,
                                           .queueCount = 1,
                                           .pQueuePriorities = &priority};
    const VkDeviceCreateInfo device = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                       .pNext = &half,
                                       .queueCreateInfoCount = 1,
                                       .pQueueCreateInfos = &queue};
    need(vkCreateDevice(gpu->physical, &device, NULL, &gpu->device), "vkCreateDevice");
    vkGetDeviceQueue(gpu->device, gpu->family, 0, &gpu->queue);
}

void gpu_open(gpu_device *gpu) {
    const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .apiVersion = VK_API_VERSION_1_2};
    const VkInstanceCreateInfo instance = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                           .pApplicationInfo = &application};
    if (vkCreateInstance(&instance, NULL, &gpu->instance) != VK_SUCCESS) {
        printf("gpu: no Vulkan driver; run scripts/install-deps shaders\n");
        exit(77);
    }
    choose_device(gpu);
    choose_family(gpu);
    choose_memory(gpu);
    describe(gpu);
    create_device(gpu);
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                          .queueFamilyIndex = gpu->family};
    need(vkCreateCommandPool(gpu->device, &pool, NULL, &gpu->pool), "vkCreateCommandPool");
    const VkCommandBufferAllocateInfo commands = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = gpu->pool,
        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
        .commandBufferCount = 1};
    need(vkAllocateCommandBuffers(gpu->device, &commands, &gpu->commands), "command buffer");
    const VkFenceCreateInfo fence = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    need(vkCreateFence(gpu->device, &fence, NULL, &gpu->fence), "vkCreateFence");
}

void gpu_close(gpu_device *gpu) {
    vkDestroyFence(gpu->device, gpu->fence, NULL);
    vkDestroyCommandPool(gpu->device, gpu->pool, NULL);
    vkDestroyDevice(gpu->device, NULL);
    vkDestroyInstance(gpu->instance, NULL);
}

void gpu_buffer_create(gpu_device *gpu, size_t size, gpu_buffer *buffer) {
    const VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                     .size = size,
                                     .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT};
    VkMemoryRequirements needs;
    need(vkCreateBuffer(gpu->device, &info, NULL, &buffer->buffer), "vkCreateBuffer");
    vkGetBufferMemoryRequirements(gpu->device, buffer->buffer, &needs);
    const VkMemoryAllocateInfo memory = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                         .allocationSize = needs.size,
                                         .memoryTypeIndex = gpu->memory_type};
    need(vkAllocateMemory(gpu->device, &memory, NULL, &buffer->memory), "vkAllocateMemory");
    need(vkBindBufferMemory(gpu->device, buffer->buffer, buffer->memory, 0), "vkBindBufferMemory");
    need(vkMapMemory(gpu->device, buffer->memory, 0, VK_WHOLE_SIZE, 0, &buffer->data),
         "vkMapMemory");
}

void gpu_buffer_destroy(gpu_device *gpu, gpu_buffer *buffer) {
    vkDestroyBuffer(gpu->device, buffer->buffer, NULL);
    vkFreeMemory(gpu->device, buffer->memory, NULL);
}

static uint32_t *read_words(const char *path, size_t *size) {
    FILE *file = fopen(path, "rb");
    uint32_t *words = malloc(1 << 20);
    *size = file && words ? fread(words, 1, 1 << 20, file) : 0;
    if (*size == 0 || *size == 1 << 20) {
        printf("gpu: can't read %s\n", path);
        exit(1);
    }
    fclose(file);
    return words;
}

static void create_layout(gpu_device *gpu, gpu_program *program) {
    VkDescriptorSetLayoutBinding bindings[GPU_BUFFERS];
    for (uint32_t i = 0; i < GPU_BUFFERS; ++i) {
        bindings[i] =
            (VkDescriptorSetLayoutBinding){.binding = i,
                                           .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                           .descriptorCount = 1,
                                           .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT};
    }
    const VkDescriptorSetLayoutCreateInfo set = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = GPU_BUFFERS,
        .pBindings = bindings};
    need(vkCreateDescriptorSetLayout(gpu->device, &set, NULL, &program->set_layout), "set layout");
    const VkPushConstantRange constants = {.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT,
                                           .size = GPU_CONSTANTS};
    const VkPipelineLayoutCreateInfo layout = {.sType =
                                                   VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                               .setLayoutCount = 1,
                                               .pSetLayouts = &program->set_layout,
                                               .pushConstantRangeCount = 1,
                                               .pPushConstantRanges = &constants};
    need(vkCreatePipelineLayout(gpu->device, &layout, NULL, &program->layout), "pipeline layout");
    const VkDescriptorPoolSize sizes = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, GPU_BUFFERS};
    const VkDescriptorPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                             .maxSets = 1,
                                             .poolSizeCount = 1,
                                             .pPoolSizes = &sizes};
    need(vkCreateDescriptorPool(gpu->device, &pool, NULL, &program->pool), "descriptor pool");
    const VkDescriptorSetAllocateInfo info = {.sType =
                                                  VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                              .descriptorPool = program->pool,
                                              .descriptorSetCount = 1,
                                              .pSetLayouts = &program->set_layout};
    need(vkAllocateDescriptorSets(gpu->device, &info, &program->set), "descriptor set");
}

void gpu_program_create(gpu_device *gpu, const char *path, gpu_program *program) {
    size_t size;
    uint32_t *words = read_words(path, &size);
    const VkShaderModuleCreateInfo module = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = size, .pCode = words};
    need(vkCreateShaderModule(gpu->device, &module, NULL, &program->module), path);
    free(words);
    create_layout(gpu, program);
    const VkComputePipelineCreateInfo pipeline = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = program->module,
                  .pName = "main"},
        .layout = program->layout};
    need(vkCreateComputePipelines(gpu->device, VK_NULL_HANDLE, 1, &pipeline, NULL,
                                  &program->pipeline),
         path);
}

void gpu_program_destroy(gpu_device *gpu, gpu_program *program) {
    vkDestroyPipeline(gpu->device, program->pipeline, NULL);
    vkDestroyDescriptorPool(gpu->device, program->pool, NULL);
    vkDestroyPipelineLayout(gpu->device, program->layout, NULL);
    vkDestroyDescriptorSetLayout(gpu->device, program->set_layout, NULL);
    vkDestroyShaderModule(gpu->device, program->module, NULL);
}

static void bind_buffers(gpu_device *gpu, gpu_program *program, const gpu_buffer *const *buffers) {
    VkDescriptorBufferInfo infos[GPU_BUFFERS];
    VkWriteDescriptorSet writes[GPU_BUFFERS];
    for (uint32_t i = 0; i < GPU_BUFFERS; ++i) {
        infos[i] = (VkDescriptorBufferInfo){buffers[i]->buffer, 0, VK_WHOLE_SIZE};
        writes[i] = (VkWriteDescriptorSet){.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                           .dstSet = program->set,
                                           .dstBinding = i,
                                           .descriptorCount = 1,
                                           .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                           .pBufferInfo = &infos[i]};
    }
    vkUpdateDescriptorSets(gpu->device, GPU_BUFFERS, writes, 0, NULL);
}

void gpu_run(gpu_device *gpu, gpu_program *program, const gpu_buffer *const *buffers,
             const void *constants, size_t size, uint32_t count) {
    const uint32_t groups = (count + GPU_GROUP - 1) / GPU_GROUP;
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                            .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    const VkMemoryBarrier to_host = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                     .srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT,
                                     .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
    const VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                 .commandBufferCount = 1,
                                 .pCommandBuffers = &gpu->commands};
    need(groups <= gpu->largest_dispatch ? VK_SUCCESS : VK_ERROR_TOO_MANY_OBJECTS, "groups");
    bind_buffers(gpu, program, buffers);
    need(vkBeginCommandBuffer(gpu->commands, &begin), "vkBeginCommandBuffer");
    vkCmdBindPipeline(gpu->commands, VK_PIPELINE_BIND_POINT_COMPUTE, program->pipeline);
    vkCmdBindDescriptorSets(gpu->commands, VK_PIPELINE_BIND_POINT_COMPUTE, program->layout, 0, 1,
                            &program->set, 0, NULL);
    if (size > 0) {
        vkCmdPushConstants(gpu->commands, program->layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                           (uint32_t)size, constants);
    }
    vkCmdDispatch(gpu->commands, groups, 1, 1);
    vkCmdPipelineBarrier(gpu->commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                         VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host, 0, NULL, 0, NULL);
    need(vkEndCommandBuffer(gpu->commands), "vkEndCommandBuffer");
    need(vkQueueSubmit(gpu->queue, 1, &submit, gpu->fence), "vkQueueSubmit");
    need(vkWaitForFences(gpu->device, 1, &gpu->fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    need(vkResetFences(gpu->device, 1, &gpu->fence), "vkResetFences");
}
