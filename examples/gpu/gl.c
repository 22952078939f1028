/* SPDX-License-Identifier: MIT */
/* A context without window or display server: on a device (EGL_EXT_device_enumeration), or on
   Mesa's surfaceless platform. */
#include "gl.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <stddef.h>
#include <stdio.h>

#define GL_DEFINE(type, name) type name;
GL_FUNCTIONS(GL_DEFINE)

#define DEVICES 16

static int context_start(EGLDisplay display)
{
    static const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                    3,
                                    EGL_CONTEXT_MINOR_VERSION,
                                    3,
                                    EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                    EGL_NONE};
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, NULL, NULL) ||
        !eglBindAPI(EGL_OPENGL_API)) {
        return 0;
    }
    EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
    return context != EGL_NO_CONTEXT &&
           eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
}

static int functions_load(void)
{
    int loaded = 1;
#define GL_LOAD(type, name) loaded &= (name = (type)eglGetProcAddress(#name)) != NULL;
    GL_FUNCTIONS(GL_LOAD)
    return loaded;
}

int gl_start(void)
{
    PFNEGLQUERYDEVICESEXTPROC devices =
        (PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress("eglQueryDevicesEXT");
    PFNEGLGETPLATFORMDISPLAYEXTPROC display_of =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    EGLDeviceEXT device[DEVICES];
    EGLint count = 0;
    if (!display_of) {
        return 0;
    }
    if (devices && !devices(DEVICES, device, &count)) {
        count = 0;
    }
    for (EGLint i = 0; i < count; i++) {
        if (context_start(display_of(EGL_PLATFORM_DEVICE_EXT, device[i], NULL))) {
            return functions_load();
        }
    }
    EGLDisplay bare = display_of(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    return context_start(bare) && functions_load();
}

GLuint gl_program(const char *vertex_shader, const char *fragment_shader)
{
    const char *source[2] = {vertex_shader, fragment_shader};
    GLuint program = glCreateProgram();
    for (int i = 0; i < 2; i++) {
        GLuint shader = glCreateShader(i == 0 ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
        glShaderSource(shader, 1, &source[i], NULL);
        glCompileShader(shader);
        glAttachShader(program, shader);
    }
    glLinkProgram(program);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) {
        char log[1024] = "";
        glGetProgramInfoLog(program, sizeof log, NULL, log);
        fprintf(stderr, "%s\n", log);
    }
    return linked ? program : 0;
}

static void attach(GLenum where, GLenum format, GLsizei size)
{
    GLuint buffer;
    glGenRenderbuffers(1, &buffer);
    glBindRenderbuffer(GL_RENDERBUFFER, buffer);
    glRenderbufferStorage(GL_RENDERBUFFER, format, size, size);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, where, GL_RENDERBUFFER, buffer);
}

int gl_target(GLsizei size)
{
    static const GLenum drawn[2] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    GLuint frame;
    glGenFramebuffers(1, &frame);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    attach(GL_COLOR_ATTACHMENT0, GL_R32UI, size);
    attach(GL_COLOR_ATTACHMENT1, GL_R32F, size);
    attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, size);
    glDrawBuffers(2, drawn);
    glViewport(0, 0, size, size);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}
