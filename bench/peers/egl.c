#include "egl.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
#include <string.h>

static EGLDisplay open_display(void) {
    const PFNEGLGETPLATFORMDISPLAYEXTPROC get_display =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    const PFNEGLQUERYDEVICESEXTPROC query_devices =
        (PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress("eglQueryDevicesEXT");
    EGLDeviceEXT device;
    EGLint count = 0;
    if (!get_display) {
        return EGL_NO_DISPLAY;
    }
    EGLDisplay display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (display && eglInitialize(display, NULL, NULL)) {
        return display;
    }
    if (!query_devices || !query_devices(1, &device, &count) || count < 1) {
        return EGL_NO_DISPLAY;
    }
    display = get_display(EGL_PLATFORM_DEVICE_EXT, device, NULL);
    return display && eglInitialize(display, NULL, NULL) ? display : EGL_NO_DISPLAY;
}

const char *burnish_peers_open_gl(int major, int minor) {
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, major, EGL_CONTEXT_MINOR_VERSION, minor,
                                 EGL_NONE};
    const EGLDisplay display = open_display();
    if (!display || !eglBindAPI(EGL_OPENGL_ES_API)) {
        return "no display without a window";
    }
    const EGLContext context =
        eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (!context || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        return "no OpenGL ES 3 context";
    }
    return NULL;
}

void burnish_peers_close_gl(void) {
    const EGLDisplay display = eglGetCurrentDisplay();
    if (display != EGL_NO_DISPLAY) {
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglTerminate(display);
    }
}
